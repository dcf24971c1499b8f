// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>

#include "discretise/discretise.hpp"
#include "tests/unit/discretise/bodies.hpp"
#include "tests/unit/discretise/inside.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::discretise::surface_nodes_test {

using test::ball;
using test::box;
using test::bumpy_brain;
using test::Inside;
const Eigen::Vector3d centre(30, -210, 55);

Discretisation with_nodes(const Surface& surface, std::size_t nodes, CellKind kind) {
  DiscretiseOptions options;
  options.nodes = nodes;
  options.cells = kind;
  return discretise(surface, nullptr, options);
}

TEST(Cloud, HasNoNodeOutsideTheSurface) {
  for (const Surface& surface : {bumpy_brain(), box({-3, 40, 7}, {20, 90, 31})}) {
    const Discretisation result = with_nodes(surface, 3000, CellKind::hexahedron);
    const Inside inside(surface);
    for (Eigen::Index node = 0; node < result.cloud.positions.rows(); ++node) {
      EXPECT_TRUE(inside(result.cloud.positions.row(node).data())) << node;
    }
  }
}

TEST(Cloud, HasItsSurfaceNodesOnTheSphere) {
  const Discretisation result = with_nodes(ball(40, centre, 6), 2000, CellKind::hexahedron);
  std::size_t on_surface = 0;
  for (std::size_t node = 0; node < result.cloud.size(); ++node) {
    const double depth = 40 - (result.cloud.positions.row(static_cast<Eigen::Index>(node)) - centre.transpose()).norm();
    if (result.cloud.on_surface[node] == 1) {
      EXPECT_LT(depth, 0.02);  // sagitta of the sphere's triangles
      ++on_surface;
    } else {
      EXPECT_GT(depth, 0.25 * result.cloud.spacing[node]);
    }
  }
  EXPECT_EQ(on_surface, result.measures.surface_nodes);
  EXPECT_GT(on_surface, 300U);
}

}  // namespace brainshift::discretise::surface_nodes_test
