// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "segmentation/geometry/point_tree.hpp"
#include "solve/load/craniotomy_load.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::solve::opening_rim_test {

const Eigen::RowVector3d centre(-60, 35, 210);
constexpr double radius = 80, opening = 25, margin = 3;

/// Points on a circle about the top of a sphere, and one amid it.
CraniotomyLoad measured_on_a_circle() {
  constexpr int points = 60;
  CraniotomyLoad load;
  load.positions.resize(points + 1, 3);
  for (int p = 0; p < points; ++p) {
    const double angle = 2 * M_PI * p / points;
    load.positions.row(p) = centre + Eigen::RowVector3d(opening * std::cos(angle), opening * std::sin(angle),
                                                        std::sqrt(radius * radius - opening * opening));
  }
  load.positions.row(points) = centre + Eigen::RowVector3d(0, 0, radius);
  load.displacement = Points::Zero(points + 1, 3);
  return load;
}

TEST(OpeningRim, RunsAllRoundTheOpeningOnTheSurface) {
  const Points rim = opening_rim(test::sphere(centre, radius, 5), measured_on_a_circle(), {.margin = margin});
  ASSERT_GT(rim.rows(), 100);
  for (const auto& place : rim.rowwise()) {
    const Eigen::RowVector3d x = place - centre;
    EXPECT_NEAR(x.head<2>().norm(), opening + margin, 0.1);  // of the polygon's corners and sides
    EXPECT_NEAR(x.norm(), radius, 0.1);                      // of the sphere's triangles
    EXPECT_GT(x.z(), 0) << "the far side lies under the same hull";
  }
  const PointTree tree(rim);
  const double height = std::sqrt(radius * radius - (opening + margin) * (opening + margin));
  for (double angle = 0; angle < 6.28; angle += 0.005) {
    const Eigen::RowVector3d x =
        centre + Eigen::RowVector3d((opening + margin) * std::cos(angle), (opening + margin) * std::sin(angle), height);
    EXPECT_LT(std::sqrt(tree.nearest(x.data()).second), 0.4) << angle;
  }
}

TEST(OpeningRim, IsNoneAboutASinglePlace) {
  CraniotomyLoad load;
  load.positions = centre + Eigen::RowVector3d(0, 0, radius);
  load.displacement = Points::Zero(1, 3);
  EXPECT_EQ(opening_rim(test::sphere(centre, radius, 4), load).rows(), 0);
}

}  // namespace brainshift::solve::opening_rim_test
