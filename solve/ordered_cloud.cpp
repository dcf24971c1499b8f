// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ordered_cloud.hpp"

#include <cmath>

#include "solve/dynamics/space_filling.hpp"
#include "solve/held_bytes.hpp"

namespace brainshift::solve {

namespace {

bool is_prescribed(const OrderedCloud& cloud, Eigen::Index node) {
  return !cloud.prescribed_displacement.row(node).array().isNaN().all();
}

}  // namespace

OrderedCloud order_nodes(const NodeCloud& cloud) {
  OrderedCloud ordered;
  ordered.original = space_filling_order(cloud.positions);
  const auto n = static_cast<Eigen::Index>(cloud.size());
  ordered.positions.resize(n, 3);
  ordered.prescribed_displacement = Points::Constant(n, 3, std::nan(""));
  ordered.force.resize(cloud.force.rows(), 3);
  for (Eigen::Index a = 0; a < n; ++a) {
    const std::int32_t from = ordered.original[static_cast<std::size_t>(a)];
    ordered.positions.row(a) = cloud.positions.row(from);
    ordered.spacing.push_back(cloud.spacing[static_cast<std::size_t>(from)]);
    ordered.on_surface.push_back(cloud.on_surface[static_cast<std::size_t>(from)]);
    if (cloud.label.size() == cloud.size()) {
      ordered.label.push_back(cloud.label[static_cast<std::size_t>(from)]);
    }
    if (cloud.prescribed_displacement.rows() == n) {
      ordered.prescribed_displacement.row(a) = cloud.prescribed_displacement.row(from);
    }
    if (cloud.force.rows() == n) {
      ordered.force.row(a) = cloud.force.row(from);
    }
  }
  return ordered;
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
