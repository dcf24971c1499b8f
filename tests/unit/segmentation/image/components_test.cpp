// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "segmentation/image/mask.hpp"
#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::components_test {

TEST(Components, OfAnEmptyMaskAreNone) {
  const Components none = components(empty_mask(3));
  EXPECT_TRUE(none.sizes.empty());
  EXPECT_EQ(none.number, std::vector<std::int32_t>(27, 0));
}

TEST(Components, TheFirstOfEquallyLargeOnesIsTheLargest) {
  Mask mask = empty_mask(5);
  mask.at(4, 0, 0) = mask.at(0, 0, 4) = 1;
  EXPECT_EQ(largest_component(mask).at(4, 0, 0), 1);
  EXPECT_EQ(largest_component(mask).at(0, 0, 4), 0);
}

TEST(Components, CornersDoNotJoinThem) {
  Mask mask = empty_mask(5);
  mask.at(1, 1, 1) = mask.at(2, 2, 1) = mask.at(3, 2, 1) = 1;
  EXPECT_EQ(components(mask).sizes, (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(count(largest_component(mask)), 2U);
}

// A flood over the faces, voxel by voxel, in the order of the voxels.
std::vector<std::int32_t> flooded(const Mask& mask) {
  std::vector<std::int32_t> number(mask.voxels.size(), 0);
  const Eigen::Array3i size = mask.geometry.size;
  const std::function<void(int, int, int, std::int32_t)> flood = [&](int i, int j, int k, std::int32_t n) {
    const bool outside = (Eigen::Array3i(i, j, k) < 0).any() || (Eigen::Array3i(i, j, k) >= size).any();
    if (outside || mask.at(i, j, k) == 0 || number[mask.geometry.offset(i, j, k)] != 0) {
      return;
    }
    number[mask.geometry.offset(i, j, k)] = n;
    for (const int step : {-1, 1}) {
      flood(i + step, j, k, n);
      flood(i, j + step, k, n);
      flood(i, j, k + step, n);
    }
  };
  std::int32_t last = 0;
  for (int k = 0; k < size.z(); ++k) {
    for (int j = 0; j < size.y(); ++j) {
      for (int i = 0; i < size.x(); ++i) {
        if (mask.at(i, j, k) != 0 && number[mask.geometry.offset(i, j, k)] == 0) {
          flood(i, j, k, ++last);
        }
      }
    }
  }
  return number;
}

TEST(Components, AreNumberedInTheOrderOfTheirFirstVoxels) {
  std::mt19937 random(5);
  for (const double share : {0.2, 0.35, 0.6}) {  // 0.31 is where one component begins to span all
    Mask mask = empty_mask(14);
    for (std::uint8_t& voxel : mask.voxels) {
      voxel = std::bernoulli_distribution(share)(random) ? 1 : 0;
    }
    EXPECT_EQ(components(mask).number, flooded(mask)) << share;
  }
}

}  // namespace brainshift::test::components_test
