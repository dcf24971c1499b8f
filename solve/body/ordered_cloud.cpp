// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/body/ordered_cloud.hpp"

#include <cmath>
#include <utility>

#include "segmentation/geometry/hilbert_order.hpp"

namespace brainshift::solve {

NodeCloud subset(const NodeCloud& cloud, const std::vector<std::int32_t>& nodes) {
  NodeCloud part;
  part.positions = cloud.positions(nodes, Eigen::all);
  for (const std::int32_t node : nodes) {
    const auto a = static_cast<std::size_t>(node);
    part.spacing.push_back(cloud.spacing[a]);
    part.on_surface.push_back(cloud.on_surface[a]);
  }
  return part;
}

OrderedCloud order_nodes(const NodeCloud& cloud, const Conditions& conditions) {
  std::vector<std::int32_t> order = hilbert_order(cloud.positions);
  Conditions ordered = subset(conditions, order);
  if (ordered.displacement.rows() == 0) {
    ordered.displacement = Points::Constant(cloud.positions.rows(), 3, std::nan(""));
  }
  return {subset(cloud, order), std::move(ordered), std::move(order)};
}

std::vector<std::int32_t> free_surface_nodes(const NodeCloud& cloud, const Conditions& conditions) {
  std::vector<std::int32_t> nodes = surface_nodes(cloud);
  std::erase_if(nodes, [&](std::int32_t a) { return conditions.is_prescribed(a); });
  return nodes;
}

bool mostly_prescribed(const NodeCloud& cloud, const Conditions& conditions) {
  return 2 * free_surface_nodes(cloud, conditions).size() < surface_nodes(cloud).size();
}

Points in_original_order(const Points& values, const std::vector<std::int32_t>& original) {
  Points result(values.rows(), 3);
  for (std::size_t a = 0; a < original.size(); ++a) {
    result.row(original[a]) = values.row(static_cast<Eigen::Index>(a));
  }
  return result;
}

std::vector<double> in_original_order(const std::vector<double>& values, const std::vector<std::int32_t>& original) {
  std::vector<double> result(values.size());
  for (std::size_t a = 0; a < original.size(); ++a) {
    result[static_cast<std::size_t>(original[a])] = values[a];
  }
  return result;
}

}  // namespace brainshift::solve
