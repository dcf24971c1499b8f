// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/region/coarse.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solve/prepare.hpp"
#include "solve/shape/shape_functions.hpp"
#include "solve/shape/support_search.hpp"

namespace brainshift::solve {

namespace {

constexpr double coarser = 2;             // spacing over that of the cloud
constexpr double least_distance = 1.41;   // of chosen nodes, over the cloud's spacing: leaves about an eighth
constexpr double looser = 0.1;            // stop, over the region's displacement
constexpr std::size_t fewest_nodes = 60;  // of a coarse cloud

bool is_prescribed(const NodeCloud& cloud, std::int32_t a) {
  return cloud.prescribed_displacement.rows() > 0 && !cloud.prescribed_displacement.row(a).array().isNaN().all();
}

/// Loaded nodes first, then the surface, then the inside; each in the cloud's order.
std::vector<std::int32_t> by_importance(const NodeCloud& cloud) {
  std::vector<std::int32_t> order;
  for (const int wanted : {0, 1, 2}) {
    for (std::size_t a = 0; a < cloud.size(); ++a) {
      const auto node = static_cast<std::int32_t>(a);
      const int rank = is_prescribed(cloud, node) ? 0 : cloud.on_surface[a] != 0 ? 1 : 2;
      if (rank == wanted) {
        order.push_back(node);
      }
    }
  }
  return order;
}

/// All free surface nodes of the cloud may touch the skull, moved by the coarse parameters: coarse nodes alone would
/// let the surface between them through, and the body sink by tenths of a millimetre.
void touch_with_whole_surface(const NodeCloud& cloud, const NodeCloud& coarse, const ShapeOptions& options,
                              Prepared& prepared) {
  std::vector<std::int32_t> surface, ordinal;
  for (std::size_t a = 0; a < cloud.size(); ++a) {
    const auto node = static_cast<std::int32_t>(a);
    if (cloud.on_surface[a] != 0 && !is_prescribed(cloud, node)) {
      ordinal.push_back(static_cast<std::int32_t>(surface.size()));
      surface.push_back(node);
    }
  }
  const Points positions = subset(cloud, surface).positions;
  const NodeCloud ordered = subset(coarse, prepared.original);
  const ShapeFunctions shape(ordered.positions, ordered.spacing, options);
  SignedDistance skull = prepared.contact->skull();
  prepared.contact.emplace(std::move(skull), positions, ordinal, shape.evaluate(positions, false));
}

}  // namespace

std::vector<std::int32_t> coarse_nodes(const NodeCloud& cloud) {
  const SupportSearch search(cloud.positions, cloud.spacing);
  std::vector<std::uint8_t> excluded(cloud.size(), 0);
  std::vector<std::int32_t> chosen;
  std::vector<std::int32_t> near;
  for (const std::int32_t a : by_importance(cloud)) {
    if (excluded[static_cast<std::size_t>(a)] != 0) {
      continue;
    }
    chosen.push_back(a);
    search.find(cloud.positions.row(a), least_distance, near);
    for (const std::int32_t node : near) {
      excluded[static_cast<std::size_t>(node)] = 1;
    }
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

namespace {

std::optional<Points> solved_on(const NodeCloud& nodes, const Model& model, const SolveOptions& given,
                                const Progress& progress) {
  Model coarse = model;
  coarse.cloud = nodes;
  for (double& spacing : coarse.cloud.spacing) {
    spacing *= coarser;
  }
  SolveOptions options = given;
  options.region = 0;
  options.points_per_cell = 1;
  options.shape = {.basis = Basis::linear, .derivatives = given.shape.derivatives};
  options.snapshot_every = 0;
  options.tolerance = std::max(given.tolerance, looser * given.region);
  SolveMeasures measures;
  Prepared prepared = prepare(coarse, options, {}, measures, progress);
  if (prepared.contact) {
    touch_with_whole_surface(model.cloud, coarse.cloud, options.shape, prepared);
  }
  const SolveResult result = step(coarse, options, std::move(prepared), measures, progress);
  if (!result.failure.empty()) {
    return std::nullopt;
  }
  const ShapeFunctions shape(coarse.cloud.positions, coarse.cloud.spacing, result.solution.shape);
  const Points parameters = parameters_from_displacement(shape, coarse.cloud.positions, result.solution.displacement);
  Points displacement = shape.interpolate(model.cloud.positions, parameters);
  const Points& prescribed = model.cloud.prescribed_displacement;
  for (Eigen::Index i = 0; i < prescribed.size(); ++i) {
    if (!std::isnan(prescribed.data()[i])) {
      displacement.data()[i] = prescribed.data()[i];
    }
  }
  return displacement;
}

}  // namespace

std::optional<Points> coarse_displacement(const Model& model, const SolveOptions& options, const Progress& progress) {
  const NodeCloud nodes = subset(model.cloud, coarse_nodes(model.cloud));
  if (nodes.size() < fewest_nodes) {
    return std::nullopt;
  }
  try {
    return solved_on(nodes, model, options, progress);
  } catch (const std::logic_error&) {
    return std::nullopt;  // what the whole cloud holds in place, the coarse one may not
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

}  // namespace brainshift::solve
