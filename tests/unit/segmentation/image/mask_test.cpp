// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/mask.hpp"

#include <gtest/gtest.h>

#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::mask_test {

TEST(Mask, CropAndBackKeepsEveryVoxelAtItsPlace) {
  Mask mask = empty_mask(9);
  mask.at(0, 4, 8) = 1;
  mask.at(3, 5, 7) = 1;
  const Mask part = cropped(mask, 2);
  EXPECT_TRUE((part.geometry.size == Eigen::Array3i(8, 6, 6)).all());
  EXPECT_EQ(part.at(2, 2, 3), 1);
  EXPECT_TRUE(part.geometry.to_world({2, 2, 3}).isApprox(mask.geometry.to_world({0, 4, 8}), 1e-12));
  EXPECT_EQ(uncropped(part, mask.geometry).voxels, mask.voxels);
}

TEST(Mask, OnlyEnclosedHolesAreFilled) {
  Mask mask = empty_mask(7);
  for (int k = 1; k < 6; ++k) {
    for (int j = 1; j < 6; ++j) {
      for (int i = 1; i < 6; ++i) {
        mask.at(i, j, k) = 1;
      }
    }
  }
  mask.at(3, 3, 3) = 0;
  EXPECT_EQ(count(holes_filled(mask)), 125U);
  mask.at(3, 3, 2) = mask.at(3, 3, 1) = 0;
  EXPECT_EQ(count(holes_filled(mask)), 122U);
}

TEST(Mask, AVoxelOnTheOutermostLayerTouchesTheBorder) {
  Mask mask = empty_mask(5);
  EXPECT_FALSE(touches_border(mask));
  mask.at(1, 3, 2) = 1;
  EXPECT_FALSE(touches_border(mask));
  mask.at(1, 4, 2) = 1;
  EXPECT_TRUE(touches_border(mask));
}

}  // namespace brainshift::test::mask_test
