// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/collinear.hpp"

#include <gtest/gtest.h>

namespace brainshift::collinear_test {

/// A row of ten along (1, 2, -2), each second one aside.
Points row(double aside) {
  Points points(10, 3);
  for (int i = 0; i < 10; ++i) {
    points.row(i) = 4.0 * i * Eigen::RowVector3d(1, 2, -2) + (i % 2) * aside * Eigen::RowVector3d(2, -1, 0);
  }
  return points;
}

TEST(AreInLine, GoesByTheWidthOfARow) {
  EXPECT_TRUE(are_in_line(row(0)));
  EXPECT_TRUE(are_in_line(row(0.5)));
  EXPECT_FALSE(are_in_line(row(0.8)));
  EXPECT_FALSE(are_in_line(row(10)));
}

TEST(AreInLine, IsTrueOfTwoPointsAndOfOne) {
  EXPECT_TRUE(are_in_line(row(3).topRows(2)));
  EXPECT_TRUE(are_in_line(row(3).topRows(1)));
}

}  // namespace brainshift::collinear_test
