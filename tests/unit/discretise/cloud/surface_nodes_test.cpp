// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "discretise/discretise.hpp"
#include "tests/unit/discretise/bodies.hpp"
#include "tests/unit/discretise/inside.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::discretise::surface_nodes_test {

using test::ball;
using test::box;
using test::bumpy_brain;
using test::Inside;
using test::with_nodes;
const Eigen::Vector3d centre(30, -210, 55);

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

TEST(Cloud, HasNodesOnTheRimOfALoadAndNoneBesideIt) {
  constexpr double radius = 40, height = 30;  // of the ball, of the rim's plane
  const double circle = std::sqrt(radius * radius - height * height);
  DiscretiseOptions options{.nodes = 3000, .craniotomy = Refinement{.centres = centre.transpose(), .factor = 1}};
  options.craniotomy->rim.resize(600, 3);
  for (Eigen::Index p = 0; p < 600; ++p) {
    const double angle = M_PI * static_cast<double>(p) / 300;
    options.craniotomy->rim.row(p) =
        centre.transpose() + Eigen::RowVector3d(circle * std::cos(angle), circle * std::sin(angle), height);
  }
  const Discretisation result = discretise(ball(radius, centre, 6), nullptr, options);
  double on_rim = 0, beside = 0;
  for (std::size_t node = 0; node < result.cloud.size(); ++node) {
    const Eigen::RowVector3d x = result.cloud.positions.row(static_cast<Eigen::Index>(node)) - centre.transpose();
    const double off = std::hypot(x.head<2>().norm() - circle, x.z() - height) / result.measures.spacing;
    if (result.cloud.on_surface[node] != 0) {
      on_rim += off < 0.05 ? 1 : 0;
      beside += off >= 0.05 && off < 0.3 ? 1 : 0;
    }
  }
  EXPECT_GT(on_rim, 0.7 * 2 * M_PI * circle / result.measures.spacing);
  EXPECT_EQ(beside, 0);
  EXPECT_GE(result.measures.smallest_distance_ratio, options.minimum_distance);
}

}  // namespace brainshift::discretise::surface_nodes_test
