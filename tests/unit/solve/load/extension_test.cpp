// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/extension.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::extension_test {

PlanePoints scattered(int count, unsigned seed = 7) {
  return test::random_points(count, 30, seed).leftCols<2>();
}

/// Two values at each point.
Values values_at(const PlanePoints& points) {
  Values values(points.rows(), 2);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    values.row(i) << std::sin(points(i, 0) / 5), 4 + points(i, 0) * points(i, 1) / 100;
  }
  return values;
}

TEST(Extension, IsExactAtThePoints) {
  const PlanePoints points = scattered(100);
  const Values values = values_at(points);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    EXPECT_LE((extended(points, values, points.row(i)) - values.row(i).transpose()).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(Extension, ReproducesLinearFieldsBetweenThePoints) {
  const PlanePoints points = scattered(60);
  const Eigen::Matrix2d slope{{0.3, -0.2}, {0.1, 0.7}};
  const Values values = points * slope;
  const PlanePoints between = scattered(20, 3);
  for (const auto& x : between.rowwise()) {
    const Eigen::Vector2d place = (10 + x.array() / 3).transpose();  // amid the points
    EXPECT_LE((extended(points, values, place) - slope.transpose() * place).norm(), 1e-9);
  }
}

TEST(Extension, TakesTheThirtyNearestPointsAlone) {
  PlanePoints points(40, 2);
  for (int i = 0; i < 40; ++i) {
    points.row(i) << (1 + i) * std::cos(i), (1 + i) * std::sin(i);
  }
  Values values = values_at(points);
  const Eigen::VectorXd before = extended(points, values, {0, 0});
  values.bottomRows<10>().array() += 1e3;
  EXPECT_EQ(extended(points, values, {0, 0}), before);
  values.row(29).array() += 1;
  EXPECT_NE(extended(points, values, {0, 0}), before);
}

TEST(Extension, StaysWithinATenthOfTheRangeOfThePoints) {
  const PlanePoints points{{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  const Values values{{0}, {10}, {0}, {10}};
  EXPECT_DOUBLE_EQ(extended(points, values, {50, 0.5})[0], 11);
  EXPECT_DOUBLE_EQ(extended(points, values, {-50, 0.5})[0], -1);
  EXPECT_NEAR(extended(points, values, {1.05, 0.5})[0], 10.5, 1e-9);
}

TEST(Extension, OfPointsThatDoNotFixASplineIsTheLeast) {
  const PlanePoints one{{3, 4}}, twice{{3, 4}, {3, 4}}, line{{0, 0}, {1, 0}, {2, 0}};
  EXPECT_NEAR(extended(one, Values{{7}}, {9, 9})[0], 7, 1e-9);
  EXPECT_NEAR(extended(twice, Values{{6}, {8}}, {3, 4})[0], 7, 1e-9) << "their mean";
  const Values rising{{0}, {1}, {2}};
  EXPECT_NEAR(extended(line, rising, {1.5, 0})[0], 1.5, 1e-9);
}

TEST(Extension, DoesNotDependOnScaleOrPlace) {
  const PlanePoints points = scattered(50);
  const Values values = values_at(points);
  const Eigen::Vector2d place(12, 17), far(-3000, 500);
  const PlanePoints elsewhere = (0.001 * points).rowwise() + far.transpose();
  EXPECT_LE((extended(points, values, place) - extended(elsewhere, values, 0.001 * place + far)).norm(), 1e-6);
}

}  // namespace brainshift::solve::extension_test
