// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/body/contact_nodes.hpp"

#include <algorithm>
#include <array>

#include "segmentation/geometry/branching_edges.hpp"
#include "segmentation/geometry/nearest_on_segment.hpp"
#include "segmentation/geometry/quantile.hpp"

namespace brainshift::solve {

namespace {

/// Whether a place is nearer than that, mm, to one of the edges of a surface.
bool is_near(const Eigen::Vector3d& x, double reach, const Surface& surface,
             const std::vector<std::array<std::int32_t, 2>>& edges) {
  return std::ranges::any_of(edges, [&](const auto& edge) {
    return (nearest_on_segment(x, surface.vertices.row(edge[0]), surface.vertices.row(edge[1])) - x).norm() < reach;
  });
}

}  // namespace

SignedDistance distance_for_contact(const Surface& skull, const OrderedCloud& cloud) {
  constexpr double from_node_to_node = 3, across = 200;  // steps of the grid: at the least, at the most
  SignedDistanceOptions all;
  const double wanted = std::max(median(cloud.spacing) / from_node_to_node, extent(skull) / across);
  const double finer = std::min(1.0, wanted / all.spacing);
  all.spacing *= finer;
  all.margin *= finer;
  SignedDistanceOptions near = all;
  near.far = false;
  near.margin -= 10 * near.spacing;  // whole steps: the samples lie where those of the full field do
  SignedDistance distance(skull, near);
  const std::vector<std::int32_t> nodes = free_surface_nodes(cloud, cloud.conditions);
  const bool far_out = std::any_of(nodes.begin(), nodes.end(), [&](std::int32_t a) {
    return distance.value(cloud.positions.row(a)) > near.band() - near.spacing;
  });
  return far_out ? SignedDistance(skull, all) : distance;
}

std::vector<std::int32_t> nodes_at_septum(const Surface& septum, const OrderedCloud& cloud) {
  const std::vector<std::array<std::int32_t, 2>> branches = branching_edges(septum.triangles);
  std::vector<std::int32_t> nodes;
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    const auto k = static_cast<std::size_t>(a);
    if (cloud.on_surface[k] != 0 || is_near(cloud.positions.row(a), 0.5 * cloud.spacing[k], septum, branches)) {
      nodes.push_back(static_cast<std::int32_t>(a));
    }
  }
  std::erase_if(nodes, [&](std::int32_t a) { return cloud.conditions.is_held(a); });
  return nodes;
}

bool is_on_wall(const SurfacePlace& foot, const Eigen::Vector3d& x, double spacing) {
  constexpr double nearest = 1e-3;  // of the spacing
  return (foot.position - x).norm() <= nearest * spacing;
}

std::vector<WallNode> nodes_at_wall(const Surface& wall, const OrderedCloud& cloud) {
  const SurfaceTree tree(wall);
  std::vector<WallNode> nodes;
  for (const std::int32_t a : surface_nodes(cloud)) {
    const Eigen::Vector3d x = cloud.positions.row(a);
    const SurfacePlace foot = tree.nearest(x);
    if (is_on_wall(foot, x, cloud.spacing[static_cast<std::size_t>(a)])) {
      nodes.push_back({a, foot.normal});
    }
  }
  return nodes;
}

}  // namespace brainshift::solve
