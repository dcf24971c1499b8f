// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "segmentation/geometry/distinct_points.hpp"
#include "segmentation/geometry/point_tree.hpp"
#include "segmentation/options/values.hpp"
#include "solve/arrays/shared_work.hpp"
#include "solve/load/craniotomy_load.hpp"
#include "solve/load/load_options.hpp"
#include "solve/load/near_surface.hpp"
#include "solve/load/opening_shape.hpp"
#include "solve/load/openings.hpp"

namespace brainshift::solve {
namespace {

/// In spacings, along the plane: nodes so little beyond the rim count as lying on it. Where none were put on it, the
/// outermost then lie nearly on it in the mean. Discretise leaves none so near but on it, unless the surface is steep.
constexpr double on_rim = 0.25;

/// Places that are looked at in one go. Most are not under the opening; those that are take a spline each.
constexpr std::int64_t splines_a_part = 4;

std::vector<std::int32_t> nodes_to_load(const NodeCloud& cloud) {
  std::vector<std::int32_t> nodes = surface_nodes(cloud);
  if (nodes.empty()) {
    throw std::invalid_argument("load: the cloud has no surface node (on_surface is 0 everywhere) to carry a load");
  }
  return nodes;
}

double distance_to(const PointTree& points, const Eigen::RowVector3d& place) {
  return std::sqrt(points.nearest(place.data()).second);
}

/// Of a single place the spacing of the nearest node.
double margin_of(const CraniotomyLoad& load, const OpeningOptions& options, const NodeCloud& cloud,
                 const std::vector<std::int32_t>& nodes) {
  if (options.margin >= 0) {
    return options.margin;
  }
  if (const std::optional<double> margin = default_margin(load.positions)) {
    return *margin;
  }
  const Points surface = cloud.positions(nodes, Eigen::all);
  const Eigen::RowVector3d place = load.positions.row(0);
  return cloud.spacing[static_cast<std::size_t>(nodes[PointTree(surface).nearest(place.data()).first])];
}

/// An opening is one sheet over its plane. Points on both sides of the brain project on each other, so that nodes
/// beside them lie off the sheet that is laid through them. spacing, taken: of the places of the surface; 1 where they
/// are under the opening.
void check_one_sheet(const CraniotomyLoad& load, const OpeningShape& opening, const Points& surface,
                     const std::vector<double>& spacing, const std::vector<std::uint8_t>& taken) {
  constexpr std::ptrdiff_t few = 2;
  constexpr double most = 0.25, beside = 0.5, far = 2;  // 1, spacings, spacings
  const Points places = distinct_points(load.positions), local = opening.local(surface);
  const PointTree measured(places);
  std::ptrdiff_t at_points = 0, off = 0;
  for (std::size_t n = 0; n < taken.size(); ++n) {
    const auto row = static_cast<Eigen::Index>(n);
    if (opening.beyond_rim(local.row(row)) <= 0 && distance_to(measured, surface.row(row)) <= beside * spacing[n]) {
      ++at_points;
      off += taken[n] == 0 && !opening.displacement_at(local.row(row), 0, far * spacing[n]) ? 1 : 0;
    }
  }
  if (off > few && static_cast<double>(off) > most * static_cast<double>(at_points)) {
    throw std::invalid_argument("load: " + std::to_string(off) + " of " + std::to_string(at_points) +
                                " surface nodes beside measured points lie off the opening that these make: they do "
                                "not lie about one opening, as on both sides of the brain or all around it; give those "
                                "of one opening, of surfaces the part that is exposed");
  }
}

}  // namespace

Points prescribed_on_surface_nodes(const NodeCloud& cloud, const CraniotomyLoad& load, const OpeningOptions& options) {
  check_table(opening_options(), options);
  check_load(load);
  const std::vector<std::int32_t> nodes = nodes_to_load(cloud);
  const Points surface = cloud.positions(nodes, Eigen::all);
  std::vector<double> spacing;
  for (const std::int32_t node : nodes) {
    spacing.push_back(cloud.spacing[static_cast<std::size_t>(node)]);
  }
  check_near_surface(load.positions, surface, options.farthest);
  check_no_places(load);
  check_moved(load.displacement, surface);
  Points prescribed = Points::Constant(cloud.positions.rows(), 3, std::numeric_limits<double>::quiet_NaN());
  for (const CraniotomyLoad& part : openings(load)) {
    const OpeningShape opening(part, surface, margin_of(part, options, cloud, nodes));
    const Points candidates = opening.local(surface);
    std::vector<std::uint8_t> taken(nodes.size(), 0);
    share_work(candidates.rows(), splines_a_part, [&](std::int64_t n) {
      const std::int32_t node = nodes[static_cast<std::size_t>(n)];
      const double past = on_rim * spacing[static_cast<std::size_t>(n)];
      if (const auto displacement = opening.displacement_at(candidates.row(n), past, options.depth)) {
        prescribed.row(node) = *displacement;
        taken[static_cast<std::size_t>(n)] = 1;
      }
    });
    check_one_sheet(part, opening, surface, spacing, taken);
  }
  if (prescribed.array().isNaN().all()) {
    const Points places = distinct_points(load.positions);
    const PointTree tree(places);
    double nearest_miss = std::numeric_limits<double>::infinity();
    for (const auto& node : surface.rowwise()) {
      nearest_miss = std::min(nearest_miss, distance_to(tree, node));
    }
    const bool tiny = (places.colwise().maxCoeff() - places.colwise().minCoeff()).norm() < 1;  // an opening in metres
    throw std::invalid_argument("load: no surface node lies under the opening; the nearest is " +
                                with_decimals(nearest_miss) + " mm from a measured point: " +
                                (places.rows() > 1 && tiny
                                     ? "all points lie within a millimetre; are they in metres? Give them in mm"
                                     : "measure more points, or use a finer cloud or a wider margin"));
  }
  return prescribed;
}

}  // namespace brainshift::solve
