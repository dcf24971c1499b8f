// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/mask.hpp"

#include <gtest/gtest.h>

#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::depth_test {

TEST(Mask, DepthIsTheDistanceToTheNearestVoxelOutside) {
  Mask mask = empty_mask(9);
  for (int i = 2; i < 7; ++i) {
    for (int j = 1; j < 8; ++j) {
      for (int k = 1; k < 8; ++k) {
        mask.at(i, j, k) = 1;
      }
    }
  }
  const ScalarImage depths = depth(mask);
  EXPECT_NEAR(depths.at(4, 4, 4), 3.0, 1e-5);
  EXPECT_NEAR(depths.at(4, 1, 4), 2.0, 1e-5);
  EXPECT_EQ(depths.at(0, 0, 0), 0.0F);
}

}  // namespace brainshift::test::depth_test
