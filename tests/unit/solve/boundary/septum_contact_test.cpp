// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/septum_contact.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/unit/solve/weighted_box.hpp"

namespace brainshift::solve::septum_contact_test {

constexpr double side = 40;

/// Two triangles in the plane z = -0.5, from -10 to `end` along x, and along y beyond a box of 40 mm.
Surface floor(double end) {
  Surface sheet{Points(4, 3), Triangles(2, 3)};
  sheet.vertices << -10, -10, -0.5, end, -10, -0.5, end, side + 10, -0.5, -10, side + 10, -0.5;
  sheet.triangles << 0, 2, 1, 0, 3, 2;
  return sheet;
}

class SeptumUnderABox : public testing::Test {
 protected:
  WeightedBox cloud;

  SeptumContact contact(double end) const {
    std::vector<std::int32_t> nodes(cloud.nodes.size());
    std::iota(nodes.begin(), nodes.end(), 0);
    return contact_of(nodes, end);
  }
  SeptumContact contact_of(const std::vector<std::int32_t>& nodes, double end) const {
    SeptumContact contact(floor(end), cloud.nodes.positions, nodes, 5, cloud.rows);
    contact.weigh(cloud.mass);
    return contact;
  }
};

TEST_F(SeptumUnderABox, LeavesABodyAloneThatDoesNotTouch) {
  SeptumContact free = contact(side + 10);
  const NodalVectors near = cloud.shifted({3, -2, -0.4});
  NodalVectors u = near;
  free.apply(u);
  EXPECT_EQ(u, near);
  EXPECT_EQ(free.measure(u).touching, 0u);
}

TEST_F(SeptumUnderABox, PutsNodesBackAlongItsNormal) {
  SeptumContact touching = contact(side + 10);
  NodalVectors u = cloud.shifted({3, -2, -1.5});
  EXPECT_NEAR(touching.measure(u).largest_penetration, 1, 1e-9);
  for (int step = 0; step < 200; ++step) {
    touching.apply(u);
  }
  EXPECT_LE(touching.measure(u).largest_penetration, 0.01);
  EXPECT_GE(touching.measure(u).touching, 20u);  // of 49
  const Points moved = cloud.displacement(u);
  EXPECT_NEAR(moved.col(0).minCoeff(), 3, 1e-9);  // frictionless
  EXPECT_NEAR(moved.col(1).maxCoeff(), -2, 1e-9);
}

TEST_F(SeptumUnderABox, LetsNodesGoThatSlidBeyondItsRim) {
  SeptumContact half = contact(side / 2);
  const double held = static_cast<double>(half.measure(cloud.shifted({0, 0, -0.5})).touching);
  EXPECT_GT(held, 0);
  EXPECT_EQ(half.measure(cloud.shifted({side, 0, -0.5})).touching, 0u);
  EXPECT_EQ(half.measure(cloud.shifted({side, 0, -3})).largest_penetration, 0);
}

/// Let go at once it would be caught again where it swings back, for ever.
TEST_F(SeptumUnderABox, LetsANodeGoGraduallyTowardsItsRim) {
  Eigen::Index node = 0;
  (cloud.nodes.positions.rowwise() - Eigen::RowVector3d(10, 20, 0)).rowwise().norm().minCoeff(&node);
  const Eigen::RowVector3d x = cloud.nodes.positions.row(node);
  const SeptumContact half = contact_of({static_cast<std::int32_t>(node)}, side / 2);
  const auto depth = [&](double from_rim) {
    const Eigen::Vector3d shift(side / 2 - from_rim - x[0], 0, -1 - x[2]);
    return half.measure(cloud.shifted(shift)).largest_penetration;
  };
  double last = depth(3);
  EXPECT_NEAR(last, 0.5, 1e-9);
  for (double from_rim = 3; from_rim > -1; from_rim -= 0.002) {
    const double now = depth(from_rim);
    EXPECT_NEAR(now, last, 0.02) << from_rim;
    last = now;
  }
  EXPECT_EQ(last, 0);
}

TEST_F(SeptumUnderABox, CountsTheWorkOfItsPushes) {
  SeptumContact touching = contact(side + 10);
  const NodalVectors before = cloud.shifted({0.2, 0, -0.9}), free = cloud.shifted({0, 0, -1});
  NodalVectors after = free;
  touching.apply(after);
  const double work = cloud.push_work(before, free, after);
  EXPECT_NE(work, 0);
  EXPECT_NEAR(touching.push_work(before, after), work, 1e-9 * std::abs(work));
}

}  // namespace brainshift::solve::septum_contact_test
