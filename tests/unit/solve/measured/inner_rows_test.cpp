// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/measured/inner_rows.hpp"

#include <gtest/gtest.h>

#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::inner_rows_test {

TEST(InnerRows, KeepALinearFieldAndAddTheSquareOfTheBallToAQuadraticOne) {
  const NodeCloud cloud = test::irregular_box(9, 80);
  const ShapeFunctions shape(cloud.positions, cloud.spacing, {});
  const Points points = Points::Constant(2, 3, 40) + test::random_points(2, 20);
  const ShapeRows rows = inner_rows(shape, points);
  ASSERT_EQ(rows.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    Eigen::RowVector4d mean = Eigen::RowVector4d::Zero();
    for (std::size_t k = 0; k < rows[i].size(); ++k) {
      const Eigen::RowVector3d x = cloud.positions.row(rows[i].node[k]);
      mean += rows[i].value[k] * Eigen::RowVector4d(1, x[0], x[1], x[2]);
    }
    EXPECT_NEAR(mean[0], 1, 1e-9);
    EXPECT_LT((mean.tail<3>() - points.row(static_cast<Eigen::Index>(i))).norm(), 1e-7);
  }
}

}  // namespace brainshift::solve::inner_rows_test
