// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "segmentation/image/mask.hpp"
#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::closing_test {

TEST(Closing, AGrownVoxelIsABallInMillimetresCutAtTheImagesEnd) {
  Mask mask = empty_mask(9);  // voxels of 1 x 2 x 3 mm
  mask.at(4, 4, 4) = 1;
  const Mask inside = grown(mask, 3);
  EXPECT_EQ(inside.at(7, 4, 4) + inside.at(1, 4, 4) + inside.at(4, 5, 4) + inside.at(4, 4, 5), 4);
  EXPECT_EQ(inside.at(8, 4, 4) + inside.at(4, 6, 4) + inside.at(5, 4, 5), 0);
  Mask corner = empty_mask(9);
  corner.at(0, 0, 0) = 1;
  EXPECT_EQ(count(grown(corner, 1)), 2U);
}

TEST(Closing, FillsGapsThatTheBallDoesNotFitInto) {
  const auto geometry = grid_around(Eigen::Vector3d::Zero(), 20, Eigen::Vector3d::Ones(), oblique());
  Mask mask{geometry, std::vector<std::uint8_t>(geometry.voxel_count())};
  for (int k = 0; k < 20; ++k) {
    for (int j = 0; j < 20; ++j) {
      for (int i = 0; i < 20; ++i) {
        mask.at(i, j, k) = i < 6 || i > 9 ? 1 : 0;  // a gap of 4 voxels from border to border
      }
    }
  }
  EXPECT_EQ(closed(mask, 1).at(7, 10, 10), 0);
  const Mask filled = closed(mask, 3);
  EXPECT_EQ(filled.at(7, 10, 10), 1);
  EXPECT_EQ(filled.at(0, 0, 0), 1);
}

}  // namespace brainshift::test::closing_test
