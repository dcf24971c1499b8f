// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/whole_body.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "segmentation/progress/stopwatch.hpp"
#include "solve/body/nodal_order.hpp"
#include "solve/cut/resection.hpp"
#include "solve/output/field_difference.hpp"
#include "solve/run/coarse.hpp"
#include "solve/run/error_estimate.hpp"
#include "solve/run/prepare.hpp"
#include "solve/run/step.hpp"
#include "solve/run/thin_parts.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift::solve {

namespace {

struct Attempt {
  SolveOptions options;
  std::string what;
};

/// Whether the end does not depend on the way to it.
bool ends_alike(const Model& model, const SolveOptions& options) {
  return options.dynamics == Dynamics::relaxation && model.cuts.empty() && !model.rupture &&
         model.curve.at(model.curve.duration()) == 1;
}

/// Whether nobody wants to see the way to the end, either.
bool may_start_near(const Model& model, const SolveOptions& options) {
  return options.start == Start::coarse && options.snapshot_every == 0 && ends_alike(model, options);
}

/// Whether a coarse solution is made: as the start, or to tell the error.
bool has_coarse(const Model& model, const SolveOptions& options) {
  return ends_alike(model, options) && !model.septum && !model.resection;
}

}  // namespace

/// In the plane it is not: a strip pressed by a quarter at ν = 0.499 folded on the way from it.
bool starts_coarse(const Model& model, const SolveOptions& options) {
  return has_coarse(model, options) && may_start_near(model, options) && model.plane == Plane::none;
}

SolveOptions of_coarse_start(SolveOptions options) {
  constexpr double factor = 0.5;  // so that what it leaves open, left_by_coarse(), is below what is wanted
  options.tolerance *= factor;
  options.load_steps = std::min(options.load_steps, 100);
  return options;
}

bool too_thin_for_quadratic(const SolveOptions& options, const SolveMeasures& measures) {
  return options.shape.basis == Basis::modified_quadratic && 2 * measures.grown_supports > measures.integration_points;
}

bool is_confined(const Model& model) {
  for (std::size_t a = 0; a < model.cloud.size(); ++a) {
    const auto node = static_cast<Eigen::Index>(a);
    const bool held = model.conditions.is_prescribed(node, 0) && model.conditions.is_prescribed(node, 1) &&
                      (model.plane != Plane::none || model.conditions.is_prescribed(node, 2));
    if (model.cloud.on_surface[a] != 0 && !held) {
      return false;
    }
  }
  return !model.conditions.measured;
}

namespace {

/// What the body is tried with after this result, in this order: none makes the answer looser.
std::vector<Attempt> further_attempts(const SolveResult& result, const SolveOptions& options) {
  constexpr int slower = 5;
  Attempt doubled{.options = options, .what = "double precision"};
  doubled.options.precision = Precision::double_precision;
  if (result.rounded) {
    return {doubled};
  }
  if (!result.unstable) {
    return {};
  }
  std::vector<Attempt> attempts = {{.options = options, .what = {}}};
  if (result.solution.shape.basis != Basis::linear) {
    attempts.push_back({.options = options, .what = "linear shape functions"});
    attempts.back().options.shape.basis = Basis::linear;
  }
  if (options.precision != Precision::double_precision) {
    attempts.push_back(doubled);
  }
  for (auto& [other, what] : attempts) {
    other.start = Start::rest;
    other.load_steps *= slower;
    what = std::to_string(other.load_steps) + " load steps" + (what.empty() ? "" : ", " + what);
  }
  return attempts;
}

/// Adds `what` before what else it took.
void put_first(const std::string& what, std::string& took) {
  took = what + (took.empty() ? "" : "; " + took);
}

/// Above some contrast of stiffness a slower load ends, but with an answer that is several times too stiff (measured:
/// two layers of 1 : 10⁶).
bool may_be_tried_again(const Model& model, const SolveOptions& options) {
  constexpr double most_contrast = 1e5;
  return options.dynamics == Dynamics::relaxation && !model.rupture &&
         stiffness_contrast(model.materials) <= most_contrast;
}

/// The displacement of the last state at the body's nodes; nothing where they cannot be told apart: face nodes of a
/// septum lie in pairs at one place.
std::optional<Points> last_displacement(const Model& model, const Points& positions) {
  const Solution& last = *model.last;
  if (last.positions.rows() == positions.rows() && last.positions == positions) {
    return as_prescribed(last.displacement, model.conditions);
  }
  if (model.septum || !last.cut.empty()) {
    return std::nullopt;
  }
  return as_prescribed(displacement_at(last, positions), model.conditions);
}

/// û of the last state, cloud's order. Shape functions beside a septum see one side of it alone: there u is near
/// enough.
std::optional<Points> last_parameters(const Model& model, const SolveOptions& options, const Body& body) {
  try {
    const std::optional<Points> u = last_displacement(model, body.positions);
    if (!u || model.septum) {
      return u;
    }
    return parameters_from_displacement({body.positions, body.spacing, options.shape}, body.positions, *u);
  } catch (const std::logic_error&) {
    return std::nullopt;  // it has too few nodes near one of these
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

/// A body that creases has more than one state at rest, and only the way of the load leads to the one that it takes. A
/// bonded slab of two spacings, pressed by a quarter, is 18 of 38 mm off else.
bool is_creased(const SolveResult& result) {
  return result.measures.compressed_share >= much_compressed;
}

/// What is left of the bound of a coarse start, mm: where it took more steps to its rest than came after it, its
/// slowest motions have hardly moved since, and the fine body's bound does not see them. A cube turned by three of its
/// nodes ends 0.0025 mm off after 220 steps, from rest after 19,200, at a bound of its own of 0.0005.
double left_by_coarse(const CoarseSolution& coarse, const SolveMeasures& fine) {
  return coarse.steps > fine.steps ? coarse.error_bound : 0;
}

/// û under the full load to start from, in the body's order; empty: from rest.
NodalVectors near_start(const Model& model, const SolveOptions& options, const std::optional<CoarseSolution>& coarse,
                        const Body& body) {
  if (model.last && may_start_near(model, options)) {
    if (const std::optional<Points> last = last_parameters(model, options, body)) {
      return in_body_order(*last, body.original);
    }
  }
  return coarse && starts_coarse(model, options) ? in_body_order(coarse->displacement, body.original) : NodalVectors();
}

SolveResult attempt(const Model& model, const SolveOptions& options, const SolveMeasures& known,
                    const Progress& progress) {
  const auto with = [&](const SolveOptions& other, const std::string& what) {
    SolveResult result = attempt(model, other, known, progress);
    put_first(what, result.measures.took);
    return result;
  };
  const Stopwatch start;
  SolveMeasures measures = known;
  Prepared prepared = prepare(model, options, {}, measures, progress);
  if (too_thin_for_quadratic(options, measures)) {
    SolveOptions linear = options;
    linear.shape.basis = Basis::linear;
    return with(linear, "linear shape functions, as the cloud is too thin for quadratic ones");
  }
  measures.seconds_setup = start.seconds();
  std::optional<CoarseSolution> coarse;
  if (has_coarse(model, options)) {
    const Stopwatch begin;
    report(progress, 0, "solving a coarse cloud");
    coarse = coarse_solution(model, of_coarse_start(options), {});
    measures.seconds_coarse = begin.seconds();
  }
  NodalVectors near = near_start(model, options, coarse, prepared.body);
  const bool from_rest = near.empty();
  measures.thin = thin_parts(model, prepared.body.placed);
  SolveResult result = step_to_end(model, options, std::move(prepared), measures, std::move(near), progress);
  if (!from_rest && result.failure.empty() && is_creased(result)) {
    report(progress, 0, "tissue creases; once more from rest");
    SolveOptions rest = options;
    rest.start = Start::rest;
    SolveResult by_load = with(rest, "the load from rest, as the tissue creases");
    if (by_load.failure.empty()) {
      return by_load;
    }
  }
  if (coarse && result.failure.empty()) {
    if (starts_coarse(model, options)) {
      result.measures.error_bound = std::max(result.measures.error_bound, left_by_coarse(*coarse, result.measures));
    }
    result.solution.estimated_error =
        estimated_error(model.cloud, result.solution.displacement, coarse->displacement, coarse->wider);
    result.measures.estimated_error_95 = percentile_95(result.solution.estimated_error);
  }
  return result;
}

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

/// Under a high pressure what patches leave to their points alone gives way: of −9 % of volume at ν = 0.499 two thirds
/// of the displacement are wrong. Pointwise and with linear shape functions it is exact, and cannot lock, as nothing
/// bulges; with quadratic ones graded clouds fold (of −16 % at ν = 0.49 two fifths are wrong).
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

/// Of two that failed: what is only not at rest tells more than what blew up. A standstill in single precision advises
/// to take double, which is then what was taken next.
bool tells_more(const SolveResult& next, const SolveResult& result) {
  return result.rounded || (result.unstable && !next.unstable && !next.rounded);
}

/// The first of the further attempts that ends well, else what tells most. One that runs out of steps leaves half as
/// many to the next. What single precision has come to is where double goes on.
SolveResult try_again(Model model, const SolveOptions& options, const SolveMeasures& known, SolveResult result,
                      const Progress& progress) {
  if (result.rounded) {
    model.last = result.solution;
  }
  int steps = options.max_steps;
  std::string tried;
  for (auto& [other, what] : further_attempts(result, options)) {
    other.max_steps = steps;
    report(progress, 0, "not at rest; once more with " + what);
    SolveResult next = attempt_under_pressure(model, other, known, progress);
    put_first(what, next.measures.took);
    if (next.failure.empty()) {
      return next;
    }
    tried += (tried.empty() ? "; tried in vain with " : ", with ") + what + " (" + std::to_string(next.measures.steps) +
             " steps)";
    steps = next.measures.steps < steps ? steps : std::max(1, steps / 2);
    if (tells_more(next, result)) {
      result = std::move(next);
    }
  }
  result.failure += tried;
  return result;
}

}  // namespace

SolveResult solve_whole_body(const Model& model, const SolveOptions& given, const Progress& progress) {
  const SolveOptions options = completed(given, model);
  SolveMeasures measures;
  std::optional<Resected> resected;
  if (model.resection) {
    resected = resect(model, options);
    measures.resection = resected->measures;
  }
  const Model& solved = resected ? resected->rest : model;
  SolveResult result = attempt_under_pressure(solved, options, measures, progress);
  if (result.failure.empty() || !may_be_tried_again(solved, options)) {
    return result;
  }
  return try_again(solved, options, measures, std::move(result), progress);
}

}  // namespace brainshift::solve
