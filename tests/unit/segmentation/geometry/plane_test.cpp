// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/plane.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace brainshift::plane_test {

TEST(Plane, IsLeftFirstByTheFirstPointWithAnotherZ) {
  Points points = Points::Random(5, 3);
  points.col(2).setZero();
  EXPECT_FALSE(off_plane(points, "node"));
  points(4, 2) = 1e-300;
  EXPECT_EQ(off_plane(points, "node")->find("node 4 has z = 1e-300 mm"), 0U);
  points(2, 2) = std::nan("");
  EXPECT_EQ(off_plane(points, "node")->find("node 2"), 0U);
}

}  // namespace brainshift::plane_test
