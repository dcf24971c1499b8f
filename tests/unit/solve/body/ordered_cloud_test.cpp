// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/body/ordered_cloud.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::ordered_cloud_test {

NodeCloud graded_box() {
  NodeCloud cloud = test::irregular_box(6, 30);
  for (std::size_t a = 0; a < cloud.size(); ++a) {
    cloud.spacing[a] = 1 + 0.01 * static_cast<double>(a);
  }
  return cloud;
}

TEST(OrderedCloud, HasEveryNodeOnceWithAllThatBelongsToIt) {
  const NodeCloud cloud = graded_box();
  Conditions conditions = test::all_free(cloud);
  conditions.displacement(17, 2) = 4;
  conditions.force = Points::Zero(cloud.positions.rows(), 3);
  conditions.force(30, 1) = 5;
  const OrderedCloud ordered = order_nodes(cloud, conditions);
  std::vector<std::int32_t> all = ordered.original;
  std::sort(all.begin(), all.end());
  for (std::size_t a = 0; a < cloud.size(); ++a) {
    ASSERT_EQ(all[a], static_cast<std::int32_t>(a));
    const auto from = static_cast<std::size_t>(ordered.original[a]);
    const auto row = static_cast<Eigen::Index>(a), old = static_cast<Eigen::Index>(from);
    EXPECT_EQ(ordered.positions.row(row), cloud.positions.row(old));
    EXPECT_EQ(ordered.spacing[a], cloud.spacing[from]);
    EXPECT_EQ(ordered.on_surface[a], cloud.on_surface[from]);
    EXPECT_EQ(ordered.conditions.is_prescribed(row), from == 17);
    EXPECT_EQ(ordered.conditions.is_pushed(row), from == 30);
  }
}

TEST(OrderedCloud, HasNeighboursNearEachOther) {
  const NodeCloud cloud = test::irregular_box(16, 45);
  const OrderedCloud ordered = order_nodes(cloud, {});
  double along = 0;
  for (Eigen::Index a = 1; a < ordered.positions.rows(); ++a) {
    along += (ordered.positions.row(a) - ordered.positions.row(a - 1)).norm();
  }
  EXPECT_LT(along / static_cast<double>(ordered.positions.rows()), 1.3 * 3) << "about the spacing from node to node";
}

TEST(OrderedCloud, HasARowOfDisplacementsWhereNothingIsPrescribed) {
  const OrderedCloud ordered = order_nodes(test::irregular_box(3, 10), {});
  EXPECT_EQ(ordered.conditions.displacement.rows(), 27);
  EXPECT_TRUE(prescribed_nodes(ordered.conditions).empty());
  EXPECT_EQ(ordered.conditions.force.rows(), 0);
}

TEST(OrderedCloud, OriginalOrderTakesTheOrderBack) {
  const NodeCloud cloud = graded_box();
  const OrderedCloud ordered = order_nodes(cloud, {});
  EXPECT_NE(ordered.positions, cloud.positions);
  EXPECT_EQ(in_original_order(ordered.positions, ordered.original), cloud.positions);
  EXPECT_EQ(in_original_order(ordered.spacing, ordered.original), cloud.spacing);
}

TEST(OrderedCloud, FreeSurfaceIsTheSurfaceWithoutWhatIsPrescribed) {
  const NodeCloud cloud = test::irregular_box(4, 30);
  EXPECT_EQ(surface_nodes(cloud).size(), 56U);  // 4³ − 2³
  Conditions conditions = test::all_free(cloud);
  conditions.displacement(0, 1) = 0;
  conditions.displacement.row(5).setZero();
  conditions.displacement.row(21).setZero();  // an inner node
  const std::vector<std::int32_t> free = free_surface_nodes(cloud, conditions);
  EXPECT_EQ(free.size(), 54U);
  EXPECT_EQ(std::count(free.begin(), free.end(), 0) + std::count(free.begin(), free.end(), 5), 0);
  EXPECT_EQ(free_surface_nodes(cloud, {}), surface_nodes(cloud));
}

}  // namespace brainshift::solve::ordered_cloud_test
