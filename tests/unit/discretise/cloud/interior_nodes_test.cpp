// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cloud/interior_nodes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "segmentation/geometry/neighbour_distance.hpp"
#include "tests/unit/discretise/bodies.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::discretise::interior_nodes_test {

using Eigen::Vector3d;

const Vector3d centre(30, -210, 55);
constexpr double radius = 20;

/// A ball whose vertices, 4.4 mm apart, are the nodes on its surface.
struct Ball {
  Surface surface = test::ball(radius, centre, 3);
  Scanlines body{surface};
};

Points filled(const Ball& ball, const SizingField& sizing, double spacing, std::size_t count, std::uint64_t seed = 1) {
  Random random(seed);
  return fill_interior(ball.surface.vertices, ball.body, sizing, spacing, count, random);
}

TEST(FillInterior, PutsAsManyNodesAsAskedInsideTheBody) {
  const Ball ball;
  for (const std::size_t count : {1U, 50U, 300U}) {
    const Points nodes = filled(ball, {}, 4.6, count);
    ASSERT_EQ(nodes.rows(), static_cast<Eigen::Index>(count));
    for (const auto& node : nodes.rowwise()) {
      EXPECT_TRUE(ball.body.inside(node.transpose()));
    }
  }
  EXPECT_EQ(filled(ball, {}, 4.6, 0).rows(), 0);
}

TEST(FillInterior, KeepsNodesApartFromEachOtherAndFromTheSurface) {
  const Ball ball;
  constexpr double spacing = 4.6;
  const Points inner = filled(ball, {}, spacing, 260);
  Points nodes(ball.surface.vertices.rows() + inner.rows(), 3);
  nodes << ball.surface.vertices, inner;
  const std::vector<double> nearest = mean_neighbour_distance(nearest_neighbours(nodes, 1));
  const auto interior = nearest.end() - inner.rows();
  EXPECT_GT(*std::min_element(interior, nearest.end()), 0.5 * spacing);
  EXPECT_LT(*std::max_element(interior, nearest.end()), 1.5 * spacing) << "nor is there a hole";
}

TEST(FillInterior, FindsRoomForMoreNodesThanTheSpacingSays) {
  const Ball ball;
  EXPECT_EQ(filled(ball, {}, 4.6, 500).rows(), 500) << "twice as many";
}

TEST(FillInterior, IsDenserWhereTheFieldAsksForIt) {
  const Vector3d reach = Vector3d::Constant(radius + 1);
  const SizingField finer_half(centre - reach, centre + reach, 1,
                               [](const Vector3d& x) { return x.x() < centre.x() ? 0.6 : 1.0; });
  const Points nodes = filled({}, finer_half, 4.6, 970);
  double fine = 0, coarse = 0;
  for (const auto& node : nodes.rowwise()) {
    if ((node.transpose() - centre).norm() < 14) {  // where the surface's nodes do not count
      fine += node.x() < centre.x() - 3 ? 1 : 0;
      coarse += node.x() > centre.x() + 3 ? 1 : 0;
    }
  }
  EXPECT_NEAR(coarse / fine, std::pow(0.6, 3), 0.08);
}

TEST(FillInterior, IsTheSameForTheSameRandomNumbersAlone) {
  const Ball ball;
  EXPECT_EQ(filled(ball, {}, 4.6, 100), filled(ball, {}, 4.6, 100));
  EXPECT_NE(filled(ball, {}, 4.6, 100), filled(ball, {}, 4.6, 100, 2));
}

TEST(VolumeDemand, IsTheVolumeDividedByTheCubedFactor) {
  const Surface box = test::box({-3, 40, 7}, {20, 90, 31});
  const double volume = 23.0 * 50 * 24;
  EXPECT_NEAR(volume_demand(box, Scanlines(box), {}), volume, 1e-9 * volume);
  const SizingField half({-3, 40, 7}, {20, 90, 31}, 5, [](const Vector3d&) { return 0.5; });
  EXPECT_NEAR(volume_demand(box, Scanlines(box), half), 8 * volume, 1e-9 * volume);
  const SizingField rising({-3, 40, 7}, {20, 90, 31}, 1,
                           [](const Vector3d& x) { return 0.5 + 0.5 * (x.x() + 3) / 23; });
  EXPECT_NEAR(volume_demand(box, Scanlines(box), rising), 3 * volume, 1e-3 * volume) << "∫ (1/2 + t/2)⁻³ dt = 3";
  const Ball ball;
  const double enclosed = brainshift::volume(ball.surface);
  EXPECT_NEAR(volume_demand(ball.surface, ball.body, {}), enclosed, 2e-3 * enclosed);
}

}  // namespace brainshift::discretise::interior_nodes_test
