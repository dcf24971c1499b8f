// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/measured/inner_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::inner_rows_test {

/// The centre of a ball and the corners of an icosahedron in it, which are (0, ±1, ±φ) and the like.
std::vector<Eigen::RowVector3d> places_in_ball(double radius) {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  std::vector<Eigen::RowVector3d> places = {{0, 0, 0}};
  for (const double one : {-1.0, 1.0}) {
    for (const double other : {-golden, golden}) {
      places.insert(places.end(), {{one, other, 0}, {0, one, other}, {other, 0, one}});
    }
  }
  for (Eigen::RowVector3d& place : places) {
    place *= radius / std::max(1e-300, place.norm());
  }
  return places;
}

TEST(InnerRows, AreTheMeanOverABallOfFourMillimetres) {
  const NodeCloud cloud = test::irregular_box(9, 80);
  const ShapeFunctions shape(cloud.positions, cloud.spacing, {.basis = Basis::quadratic});
  const Points points = Points::Constant(2, 3, 40) + test::random_points(2, 20);
  const ShapeRows rows = inner_rows(shape, points);
  for (std::size_t i = 0; i < 2; ++i) {
    const Eigen::RowVector3d point = points.row(static_cast<Eigen::Index>(i));
    double mean = 0, of_places = 0;
    for (std::size_t k = 0; k < rows[i].size(); ++k) {
      mean += rows[i].value[k] * (cloud.positions.row(rows[i].node[k]) - point).squaredNorm();
    }
    for (const Eigen::RowVector3d& place : places_in_ball(4)) {
      const ShapeRows of_place = shape.evaluate(Points(point + place), false);
      for (std::size_t k = 0; k < of_place[0].size(); ++k) {
        const Eigen::RowVector3d arm = cloud.positions.row(of_place[0].node[k]) - point;
        of_places += of_place[0].value[k] * arm.squaredNorm() / 13;
      }
    }
    EXPECT_NEAR(mean, of_places, 1e-9);
    EXPECT_GT(mean, 12) << "of a field |x|², 16 mm² at twelve of thirteen places";
  }
}

TEST(InnerRows, KeepALinearField) {
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
