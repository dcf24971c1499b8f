// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/distinct_points.hpp"

#include <gtest/gtest.h>

namespace brainshift::distinct_points_test {

TEST(DistinctPoints, AreEachPointOnceInAscendingOrder) {
  Points points(5, 3), expected(3, 3);
  points << 2, 0, 0, 1, 5, 0, 2, 0, 0, 1, 4, 9, 1, 5, 0;
  expected << 1, 4, 9, 1, 5, 0, 2, 0, 0;
  EXPECT_EQ(distinct_points(points), expected);
  EXPECT_EQ(distinct_points(Points(0, 3)).rows(), 0);
}

}  // namespace brainshift::distinct_points_test
