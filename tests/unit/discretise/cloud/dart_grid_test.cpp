// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cloud/dart_grid.hpp"

#include <gtest/gtest.h>

#include <random>

namespace brainshift::discretise::dart_grid_test {

TEST(DartGrid, SaysWhatLookingAtAllAcceptedPointsSays) {
  const Eigen::Vector3d low(-20, 30, 40), high(-8, 37, 60);
  constexpr double reach = 1.5;
  DartGrid grid(low, high, reach);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<Eigen::Vector3d> accepted;
  int refused = 0;
  for (int dart = 0; dart < 1500; ++dart) {
    const Eigen::Vector3d at(share(random), share(random), share(random));
    const Eigen::Vector3d x = low + at.cwiseProduct(high - low);
    const double distance = reach * share(random);
    bool free = true;
    for (const Eigen::Vector3d& other : accepted) {
      free = free && (other - x).norm() >= distance;
    }
    ASSERT_EQ(grid.is_free(x, distance), free) << dart;
    refused += free ? 0 : 1;
    if (free) {
      grid.accept(x);
      accepted.push_back(x);
    }
  }
  EXPECT_GT(refused, 50);
  EXPECT_GT(accepted.size(), 50U);
}

TEST(DartGrid, APointAtTheVeryDistanceIsFarEnough) {
  DartGrid grid({0, 0, 0}, {10, 10, 10}, 2);
  grid.accept({5, 5, 5});
  EXPECT_TRUE(grid.is_free({7, 5, 5}, 2));
  EXPECT_FALSE(grid.is_free({6.999, 5, 5}, 2));
  EXPECT_FALSE(grid.is_free({5, 5, 5}, 1e-9));
  EXPECT_TRUE(grid.is_free({5, 5, 5}, 0));
}

TEST(DartGrid, HoldsPointsOnItsBoxsCorners) {
  const Eigen::Vector3d low(0, 0, 0), high(10, 10, 10);
  DartGrid grid(low, high, 3);
  grid.accept(low);
  grid.accept(high);
  EXPECT_FALSE(grid.is_free({1, 1, 1}, 2));
  EXPECT_FALSE(grid.is_free({9, 9, 9}, 2));
  EXPECT_TRUE(grid.is_free({5, 5, 5}, 3));
}

}  // namespace brainshift::discretise::dart_grid_test
