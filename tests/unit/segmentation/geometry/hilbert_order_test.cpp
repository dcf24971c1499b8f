// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/hilbert_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace brainshift::hilbert_order_test {

/// Places of a lattice of side³, mixed up.
Points mixed_lattice(int side) {
  std::vector<int> numbers(static_cast<std::size_t>(side * side * side));
  std::iota(numbers.begin(), numbers.end(), 0);
  std::shuffle(numbers.begin(), numbers.end(), std::mt19937(3));
  Points points(static_cast<Eigen::Index>(numbers.size()), 3);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const int n = numbers[i];
    points.row(static_cast<Eigen::Index>(i)) << n % side, n / side % side, n / (side * side);
  }
  return points;
}

TEST(HilbertOrder, HoldsEachPointOnceWhereSomeCoincideToo) {
  Points points = Points::Random(500, 3);
  points.bottomRows(100) = points.topRows(100).eval();
  std::vector<std::int32_t> order = hilbert_order(points);
  std::sort(order.begin(), order.end());
  std::vector<std::int32_t> all(500);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(order, all);
}

TEST(HilbertOrder, GoesThroughALatticeInStepsToTheNextPoint) {
  const Points lattice = mixed_lattice(8);
  const std::vector<std::int32_t> order = hilbert_order(lattice);
  for (std::size_t i = 1; i < order.size(); ++i) {
    EXPECT_EQ((lattice.row(order[i]) - lattice.row(order[i - 1])).norm(), 1.0) << i;
  }
}

TEST(HilbertOrder, OfNoPointIsEmpty) {
  EXPECT_TRUE(hilbert_order(Points(0, 3)).empty());
  EXPECT_EQ(hilbert_order(Points::Zero(1, 3)), std::vector<std::int32_t>{0});
}

}  // namespace brainshift::hilbert_order_test
