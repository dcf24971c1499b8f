// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/warp/warp.hpp"

#include <gtest/gtest.h>

#include "tests/unit/register/builders.hpp"

namespace brainshift::registration::move_points_test {

using namespace builders;

const ImageGeometry small = grid({24, 20, 18}, {1.5, 1.5, 1.5});

TEST(MovePoints, CountTheOutermostHalfVoxelAsInside) {
  const Eigen::Vector3d u(1, 2, 3);
  const VectorImage forward = field(small, [&](const Eigen::Vector3d&) { return u; });
  const Eigen::Vector3d last = (small.size - 1).cast<double>().matrix();
  Points points(4, 3);
  points.row(0) = small.to_world(Eigen::Vector3d::Constant(-0.499)).transpose();
  points.row(1) = small.to_world(last + Eigen::Vector3d::Constant(0.499)).transpose();
  points.row(2) = small.to_world(Eigen::Vector3d(-0.501, 3, 3)).transpose();
  points.row(3) = small.to_world(last + Eigen::Vector3d(0, 0, 0.501)).transpose();
  const Points moved = move_points(forward, points);
  EXPECT_LT((moved.topRows(2) - points.topRows(2) - u.transpose().replicate(2, 1)).norm(), 1e-6);
  EXPECT_EQ(moved.bottomRows(2), points.bottomRows(2));
}

}  // namespace brainshift::registration::move_points_test
