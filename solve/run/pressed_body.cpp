// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/pressed_body.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "solve/run/attempt.hpp"

namespace brainshift::solve {

bool is_confined(const Model& model) {
  bool has_surface = false;
  for (std::size_t a = 0; a < model.cloud.size(); ++a) {
    const auto node = static_cast<Eigen::Index>(a);
    const bool held = model.conditions.is_prescribed(node, 0) && model.conditions.is_prescribed(node, 1) &&
                      (model.plane != Plane::none || model.conditions.is_prescribed(node, 2));
    has_surface = has_surface || model.cloud.on_surface[a] != 0;
    if (model.cloud.on_surface[a] != 0 && !held) {
      return false;
    }
  }
  return has_surface && !model.conditions.measured;
}

namespace {

/// What a body all of whose surface is prescribed keeps of its volume, by the affine motion nearest to that surface's.
double prescribed_volume(const Model& model) {
  const std::vector<std::int32_t> surface = surface_nodes(model.cloud);
  if (surface.empty()) {
    return 1;
  }
  const Points x = model.cloud.positions(surface, Eigen::all);
  const Points u = model.conditions.displacement(surface, Eigen::all);
  const Eigen::MatrixXd about = x.rowwise() - x.colwise().mean(), moved = u.rowwise() - u.colwise().mean();
  const Eigen::Matrix3d gradient = about.completeOrthogonalDecomposition().solve(moved).transpose();
  return (Eigen::Matrix3d::Identity() + gradient).determinant();
}

/// Whether such a change of volume puts all tissues under a high pressure. Points do not tell once they have folded,
/// as that takes the pressure off them.
bool is_squeezed(const Model& model, const SolveOptions& options) {
  if (model.plane != Plane::none || !ends_alike(model, options)) {
    return false;
  }
  const double change = std::abs(prescribed_volume(model) - 1);
  return std::ranges::all_of(model.materials, [&](const auto& row) {
    return bulk_modulus(row.second) * change > most_pressure * shear_modulus(row.second);
  });
}

/// Whether there are enough integration points a node where they are fewest: with less, some clouds fold under pressure
/// (a graded cube with 2.2 and with 3.8, others with 2.4 not).
bool holds_under_pressure(const SolveResult& result) {
  constexpr double points_that_hold = 8;
  return result.measures.fewest_points >= points_that_hold;
}

/// With pointwise dilatation and linear shape functions. Cells are split up to 64, then up to 512 parts if it takes
/// that for points that hold, where these are not too many and nobody asked for a way to split cells. patchwise: the
/// result without all this.
SolveResult attempt_pointwise(const Model& model, SolveOptions options, const SolveResult& patchwise,
                              const SolveMeasures& known, const Progress& progress) {
  const auto may_split = [&](int depth) {
    constexpr std::size_t most_points = 1'000'000;
    return model.plane == Plane::none && model.cells.size() << (3 * depth) <= most_points;
  };
  options.volumetric = Volumetric::pointwise;
  options.shape.basis = Basis::linear;
  if (holds_under_pressure(patchwise) || options.integration_tolerance > 0 || !may_split(2)) {
    return attempt(model, options, known, progress);
  }
  options.integration_tolerance = 0.1;
  options.points_per_cell = 1;
  options.integration_depth = 2;
  SolveResult result = attempt(model, options, known, progress);
  if (!holds_under_pressure(result) && result.measures.capped_points > 0 && may_split(3)) {
    options.integration_depth = 3;
    SolveResult finer = attempt(model, options, known, progress);
    if (finer.failure.empty()) {
      return finer;
    }
  }
  return result;
}

}  // namespace

SolveResult attempt_under_pressure(const Model& model, const SolveOptions& options, const SolveMeasures& known,
                                   const Progress& progress) {
  SolveResult result = attempt(model, options, known, progress);
  const bool pointwise_asked = options.volumetric == Volumetric::pointwise;
  if (pointwise_asked || !is_confined(model) ||
      (result.measures.pressed_share < much_pressed && !is_squeezed(model, options))) {
    return result;
  }
  report(progress, 0, "under high pressure; once more with pointwise dilatation and linear shape functions");
  SolveResult next = attempt_pointwise(model, options, result, known, progress);
  const bool solid = model.plane == Plane::none;
  if (!next.failure.empty()) {
    result.measures.pressed_share = solid ? 1 : result.measures.pressed_share;
    return result;
  }
  if (solid && !holds_under_pressure(next)) {
    next.measures.pressed_share = 1;
  }
  const bool split = next.measures.integration_points > result.measures.integration_points;
  put_first(std::string("pointwise dilatation and linear shape functions") + (split ? " in split cells" : "") +
                ", as the volume that is prescribed puts the tissue under high pressure",
            next.measures.took);
  return next;
}

}  // namespace brainshift::solve
