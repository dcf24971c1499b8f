// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "segmentation/geometry/point_tree.hpp"
#include "solve/interface/solution.hpp"

namespace brainshift::registration {

/// How far a place, mm, lies from the nearest node of a solution, in that node's spacings. nodes: of its positions.
inline double spacings_to_node(const PointTree& nodes, const Solution& solution, const Eigen::Vector3d& x) {
  const auto [node, squared] = nodes.nearest(x.data());
  return std::sqrt(squared) / solution.spacing[node];
}

}  // namespace brainshift::registration
