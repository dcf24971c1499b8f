// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>

#include "discretise/interface/node_cloud.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::pipelines {

/// Nodes, called 4 mm apart, on a sphere of radius 60 mm about the origin.
inline NodeCloud ball() {
  NodeCloud cloud;
  cloud.positions = brainshift::test::sphere({0, 0, 0}, 60, 4).vertices;
  const auto nodes = static_cast<std::size_t>(cloud.positions.rows());
  cloud.spacing.assign(nodes, 4);
  cloud.on_surface.assign(nodes, 1);
  return cloud;
}

/// Of the nodes of the ball, (n × 3) mm: under an opening at its top 1, else NaN.
inline Points prescribed_on_top() {
  const NodeCloud cloud = ball();
  Points prescribed = Points::Constant(cloud.positions.rows(), 3, std::numeric_limits<double>::quiet_NaN());
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    if (cloud.positions(a, 2) > 45) {
      prescribed.row(a).setConstant(1);
    }
  }
  return prescribed;
}

}  // namespace brainshift::pipelines
