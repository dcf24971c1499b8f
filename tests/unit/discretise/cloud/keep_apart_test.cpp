// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cloud/keep_apart.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace brainshift::discretise::keep_apart_test {

/// A lattice of `side`³ nodes one mm apart.
Points lattice(int side) {
  Points nodes(side * side * side, 3);
  for (int n = 0; n < side * side * side; ++n) {
    nodes.row(n) << n % side, n / side % side, n / (side * side);
  }
  return nodes;
}

/// The lattice with one more node, 0.2 mm from its middle one.
Points with_a_near_node() {
  Points nodes = lattice(5);
  nodes.conservativeResize(126, 3);
  nodes.row(125) << 2.2, 2, 2;
  return nodes;
}

TEST(KeepApart, LeavesALatticeAlone) {
  const std::vector<char> keep = keep_apart(lattice(5), 0, 0.7);
  EXPECT_EQ(std::count(keep.begin(), keep.end(), 1), 125);
}

TEST(KeepApart, LeavesOutTheLaterOfTwoNodesInTheInterior) {
  const std::vector<char> keep = keep_apart(with_a_near_node(), 0, 0.5);
  EXPECT_EQ(std::count(keep.begin(), keep.end(), 0), 1);
  EXPECT_EQ(keep[125], 0);
}

TEST(KeepApart, KeepsTheNodeOnTheSurface) {
  Points nodes = with_a_near_node();
  nodes.row(0).swap(nodes.row(125));  // the near node comes first, and the middle one is still number 62
  const std::vector<char> on_surface = keep_apart(nodes, 1, 0.5);
  EXPECT_EQ(on_surface[0], 1);
  EXPECT_EQ(on_surface[62], 0);
  const std::vector<char> all_on_surface = keep_apart(nodes, 126, 0.5);
  EXPECT_EQ(all_on_surface[0], 1);
  EXPECT_EQ(all_on_surface[62], 0);
}

TEST(KeepApart, TheFractionDecidesWhatIsTooNear) {
  const std::vector<char> keep = keep_apart(with_a_near_node(), 0, 0.15);
  EXPECT_EQ(std::count(keep.begin(), keep.end(), 0), 0) << "0.2 mm are more than 0.15 of about 1 mm";
}

TEST(KeepApart, OfThreeNodesInAHeapOneIsLeft) {
  Points nodes = with_a_near_node();
  nodes.conservativeResize(127, 3);
  nodes.row(126) << 2, 2.1, 2;
  const std::vector<char> keep = keep_apart(nodes, 0, 0.5);
  EXPECT_LE(keep[62] + keep[125] + keep[126], 2);
  EXPECT_GE(keep[62] + keep[125] + keep[126], 1);
}

TEST(CloudDistances, OfALatticeAreItsStepAwayFromTheRim) {
  const CloudDistances distances = cloud_distances(lattice(7));
  const std::size_t middle = 3 + 7 * (3 + 7 * 3);
  EXPECT_DOUBLE_EQ(distances.nearest[middle], 1);
  EXPECT_DOUBLE_EQ(distances.spacing[middle], 1);
  EXPECT_DOUBLE_EQ(distances.nearest[0], 1);
  EXPECT_GT(distances.spacing[0], 1) << "a corner has three at one mm, the others farther";
  const CloudDistances wider = cloud_distances(2.5 * lattice(7));
  EXPECT_DOUBLE_EQ(wider.spacing[0], 2.5 * distances.spacing[0]);
}

TEST(CloudDistances, EvenOutTheSpacingOverTheNeighbours) {
  const Points nodes = with_a_near_node();
  const CloudDistances distances = cloud_distances(nodes);
  EXPECT_NEAR(distances.nearest[62], 0.2, 1e-12);
  EXPECT_GT(distances.spacing[62], 0.8) << "one near node hardly tells in the mean of seven means of six";
}

}  // namespace brainshift::discretise::keep_apart_test
