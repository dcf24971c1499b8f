// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ordered_cloud.hpp"

#include <cmath>
#include <utility>

#include "solve/dynamics/space_filling.hpp"
#include "solve/held_bytes.hpp"

namespace brainshift::solve {

namespace {

bool is_prescribed(const OrderedCloud& cloud, Eigen::Index node) {
  return !cloud.prescribed_displacement.row(node).array().isNaN().all();
}

}  // namespace

NodeCloud subset(const NodeCloud& cloud, const std::vector<std::int32_t>& nodes) {
  NodeCloud part;
  const auto n = static_cast<Eigen::Index>(nodes.size());
  part.positions = cloud.positions(nodes, Eigen::all);
  part.prescribed_displacement = Points::Constant(n, 3, std::nan(""));
  if (cloud.prescribed_displacement.rows() > 0) {
    part.prescribed_displacement = cloud.prescribed_displacement(nodes, Eigen::all);
  }
  if (cloud.force.rows() > 0) {
    part.force = cloud.force(nodes, Eigen::all);
  }
  for (const std::int32_t node : nodes) {
    const auto a = static_cast<std::size_t>(node);
    part.spacing.push_back(cloud.spacing[a]);
    part.on_surface.push_back(cloud.on_surface[a]);
    if (cloud.label.size() == cloud.size()) {
      part.label.push_back(cloud.label[a]);
    }
  }
  return part;
}

OrderedCloud order_nodes(const NodeCloud& cloud) {
  std::vector<std::int32_t> order = space_filling_order(cloud.positions);
  NodeCloud ordered = subset(cloud, order);
  return {std::move(ordered), std::move(order)};
}

std::vector<std::int32_t> surface_nodes(const OrderedCloud& cloud) {
  std::vector<std::int32_t> nodes;
  for (std::size_t a = 0; a < cloud.on_surface.size(); ++a) {
    if (cloud.on_surface[a] != 0) {
      nodes.push_back(static_cast<std::int32_t>(a));
    }
  }
  return nodes;
}

std::vector<std::int32_t> free_surface_nodes(const OrderedCloud& cloud) {
  std::vector<std::int32_t> nodes = surface_nodes(cloud);
  std::erase_if(nodes, [&](std::int32_t a) { return is_prescribed(cloud, a); });
  return nodes;
}

std::size_t count_loaded(const OrderedCloud& cloud) {
  std::size_t loaded = 0;
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    const bool pushed = cloud.force.rows() > 0 && !cloud.force.row(a).isZero();
    loaded += pushed || is_prescribed(cloud, a) ? 1 : 0;
  }
  return loaded;
}

std::size_t cloud_bytes(const NodeCloud& cloud) {
  const Eigen::Index numbers = cloud.positions.size() + cloud.prescribed_displacement.size() + cloud.force.size();
  return static_cast<std::size_t>(numbers) * sizeof(double) + bytes(cloud.spacing) + bytes(cloud.on_surface) +
         bytes(cloud.label);
}

Points in_original_order(const Points& values, const std::vector<std::int32_t>& original) {
  Points result(values.rows(), 3);
  for (std::size_t a = 0; a < original.size(); ++a) {
    result.row(original[a]) = values.row(static_cast<Eigen::Index>(a));
  }
  return result;
}

}  // namespace brainshift::solve
