// SPDX-License-Identifier: GPL-3.0-or-later

#include "solve/shape/visibility.hpp"

#include <gtest/gtest.h>

#include "tests/unit/solve/completeness.hpp"
#include "tests/unit/solve/cut_bodies.hpp"

namespace brainshift::solve::visibility_test {

TEST(LevelSets, TellTheFourRegionsAboutATip) {
  const Eigen::Vector3d end(2, 1, 0), along(3, 4, 0);  // V/|V| = (0.6, 0.8)
  const LevelSets ahead_left = level_sets({1.8, 3.4, 0}, end, along);
  EXPECT_NEAR(ahead_left.psi, -0.2 * 0.8 - 2.4 * 0.6, 1e-12);
  EXPECT_NEAR(ahead_left.phi, -0.2 * 0.6 + 2.4 * 0.8, 1e-12);  // a plus: φ is orthogonal to ψ
  EXPECT_GT(level_sets({5, 3, 0}, end, along).psi, 0);
  EXPECT_GT(level_sets({5, 3, 0}, end, along).phi, 0);
  EXPECT_LT(level_sets({0, 1, 0}, end, along).psi, 0);
  EXPECT_LT(level_sets({0, 1, 0}, end, along).phi, 0);
  EXPECT_GT(level_sets({2, -3, 0}, end, along).psi, 0);
  EXPECT_LT(level_sets({2, -3, 0}, end, along).phi, 0);
}

TEST(Visibility, HidesWhatLiesBehindAPathAndShowsTheRest) {
  const Visibility cut(test::path({{0, 0}, {4, 0}, {6, 2}}, true));
  EXPECT_TRUE(cut.detour({1, 1, 0}, {2, -1, 0}));
  EXPECT_TRUE(cut.detour({5, 2, 0}, {5.5, 0.5, 0})) << "behind the second segment";
  EXPECT_FALSE(cut.detour({1, 1, 0}, {3, 0.1, 0})) << "on the same side";
  EXPECT_FALSE(cut.detour({7, 2, 0}, {6, 3, 0})) << "ahead of the tip";
  EXPECT_TRUE(cut.detour({4, 1, 0}, {4, -1, 0})) << "through the kink there is no gap";
  EXPECT_TRUE(cut.detour({2, 0, 0}, {2, -1, 0})) << "a place on the cut is on its left";
  EXPECT_FALSE(cut.detour({2, 0, 0}, {2, 1, 0}));
}

TEST(Visibility, GoesRoundTheTipOnTheShortestWay) {
  const Visibility cut(test::path({{0, 0}, {4, 0}}, true));
  const Eigen::Vector3d x(3, 1, 0), node(2, -2, 0), tip(4, 0, 0);
  const auto detour = cut.detour(x, node);
  ASSERT_TRUE(detour);
  EXPECT_NEAR(detour->length, (x - tip).norm() + (node - tip).norm(), 1e-12);
  EXPECT_NEAR((detour->gradient - (x - tip).normalized()).norm(), 0, 1e-12);
  const Visibility through(test::path({{0, 0}, {4, 0}}, false));
  EXPECT_TRUE(std::isinf(through.detour(x, node)->length)) << "a cut without a front";
}

TEST(Visibility, OfASheetIsThatOfItsPathInEveryPlane) {
  const Visibility path(test::path({{0, 0}, {4, 0}}, true)), sheet(test::sheet_along_x(4));
  const Points places = test::random_points(400, 1);
  for (Eigen::Index i = 0; i + 1 < places.rows(); ++i) {
    const Eigen::Vector3d x(6 * places(i, 0) + 0.5, 4 * places(i, 1) - 2, 0.3);
    const Eigen::Vector3d node(6 * places(i + 1, 0) + 0.5, 4 * places(i + 1, 1) - 2, 0.3);
    const Eigen::Vector3d flat(1, 1, 0);
    const auto in_plane = path.detour(x.cwiseProduct(flat), node.cwiseProduct(flat)), in_space = sheet.detour(x, node);
    ASSERT_EQ(in_plane.has_value(), in_space.has_value()) << x.transpose() << " to " << node.transpose();
    if (in_plane) {
      EXPECT_NEAR(in_plane->length, in_space->length, 1e-9);
    }
  }
}

TEST(Visibility, FindsTheShortestWayOverAnEdgeInSpace) {
  const Visibility sheet(test::sheet_along_x(4));  // its front is x = 4, y = 0, z from -9 to 9
  const Eigen::Vector3d x(3, 1, -2), node(3.5, -0.5, 1);
  double shortest = 1e9;
  for (int i = 0; i <= 18000; ++i) {
    const Eigen::Vector3d over(4, 0, -9 + 0.001 * i);
    shortest = std::min(shortest, (x - over).norm() + (node - over).norm());
  }
  EXPECT_NEAR(sheet.detour(x, node)->length, shortest, 1e-6);
}

TEST(CutShapeFunctions, ReproduceLinearFieldsOnBothSides) {
  const NodeCloud cloud = test::irregular_rectangle(12, 12, 11, 11);
  const auto cut = std::make_shared<const Visibility>(test::path({{-1, 5.2}, {4, 5.2}, {6.5, 6.7}}, true));
  for (const Basis basis : {Basis::linear, Basis::modified_quadratic}) {
    const ShapeFunctions shape(cloud.positions, cloud.spacing, {.basis = basis, .planar = true}, cut);
    Points at = test::random_points(500, 11);
    at.col(2).setZero();
    const ShapeRows rows = shape.evaluate(at, true);
    double sum = 0, gradient = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      Eigen::Vector3d place = Eigen::Vector3d::Zero();
      Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();
      for (auto k = static_cast<std::size_t>(rows.begin[i]); k < static_cast<std::size_t>(rows.begin[i + 1]); ++k) {
        const Eigen::Vector3d node = cloud.positions.row(rows.node[k]);
        place += rows.value[k] * node;
        slope += node * Eigen::Map<const Eigen::RowVector3d>(&rows.derivative[3 * k]);
      }
      sum = std::max(sum, (place - at.row(static_cast<Eigen::Index>(i)).transpose()).norm());
      gradient = std::max(gradient, (slope.topLeftCorner<2, 2>() - Eigen::Matrix2d::Identity()).norm());
    }
    EXPECT_LT(sum, 1e-9);
    EXPECT_LT(gradient, 1e-7);
  }
}

TEST(CutShapeFunctions, SeeNothingThroughACutWithoutAFront) {
  const NodeCloud cloud = test::irregular_rectangle(12, 12, 11, 11);
  const auto cut = std::make_shared<const Visibility>(test::path({{-1, 5.2}, {12, 5.2}}, false));
  const ShapeFunctions shape(cloud.positions, cloud.spacing, {.planar = true}, cut);
  Points at = test::random_points(500, 11);
  at.col(2).setZero();
  const ShapeRows rows = shape.evaluate(at, false);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (auto k = static_cast<std::size_t>(rows.begin[i]); k < static_cast<std::size_t>(rows.begin[i + 1]); ++k) {
      EXPECT_EQ(at(static_cast<Eigen::Index>(i), 1) < 5.2, cloud.positions(rows.node[k], 1) < 5.2);
    }
  }
}

/// Largest change of a field of random parameters from one place to the next along a line.
double largest_jump(const ShapeFunctions& shape, const NodeCloud& cloud, const Eigen::RowVector3d& from,
                    const Eigen::RowVector3d& to, int steps) {
  Points at(steps + 1, 3), values = test::random_points(static_cast<int>(cloud.size()), 1, 5);
  for (int i = 0; i <= steps; ++i) {
    at.row(i) = from + (to - from) * i / steps;
  }
  const Points field = shape.interpolate(at, values);
  return (field.bottomRows(steps) - field.topRows(steps)).rowwise().norm().maxCoeff();
}

TEST(CutShapeFunctions, AreContinuousButAcrossTheCut) {
  const NodeCloud cloud = test::irregular_rectangle(12, 12, 11, 11);
  const auto cut = std::make_shared<const Visibility>(test::path({{-1, 5.2}, {5.4, 5.2}}, true));
  const ShapeFunctions shape(cloud.positions, cloud.spacing, {.basis = Basis::linear, .planar = true}, cut);
  const auto jump = [&](const Eigen::RowVector3d& from, const Eigen::RowVector3d& to, int steps) {
    return largest_jump(shape, cloud, from, to, steps);
  };
  // across the shadow of the tip, ahead of it, and beside the cut: ten times as many steps, a tenth of the change
  for (const auto& [from, to] : {std::pair{Eigen::RowVector3d(5.0, 6.5, 0), Eigen::RowVector3d(6.2, 5.5, 0)},
                                 {Eigen::RowVector3d(5.6, 4.2, 0), Eigen::RowVector3d(5.6, 6.2, 0)},
                                 {Eigen::RowVector3d(4.0, 5.4, 0), Eigen::RowVector3d(6.5, 5.4, 0)}}) {
    EXPECT_LT(jump(from, to, 20000), 0.2 * jump(from, to, 2000));
  }
  EXPECT_GT(jump({2, 4.7, 0}, {2, 5.7, 0}, 20000), 0.1) << "across the cut";
}

TEST(CutShapeFunctions, HaveTheDerivativesOfTheirValues) {
  const NodeCloud cloud = test::irregular_rectangle(12, 12, 11, 11);
  const auto cut = std::make_shared<const Visibility>(test::path({{-1, 5.2}, {5.4, 5.2}}, true));
  const ShapeFunctions shape(cloud.positions, cloud.spacing, {.planar = true}, cut);
  Points places(3, 3);
  places << 5.0, 5.6, 0, 5.8, 5.0, 0, 4.4, 4.9, 0;
  constexpr double step = 1e-6;
  const Points values = test::random_points(static_cast<int>(cloud.size()), 1, 5);
  const ShapeRows rows = shape.evaluate(places, true);
  for (int axis = 0; axis < 2; ++axis) {
    Points ahead = places, behind = places;
    ahead.col(axis).array() += step;
    behind.col(axis).array() -= step;
    const Points slope = (shape.interpolate(ahead, values) - shape.interpolate(behind, values)) / (2 * step);
    for (std::size_t i = 0; i < 3; ++i) {
      Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
      for (auto k = static_cast<std::size_t>(rows.begin[i]); k < static_cast<std::size_t>(rows.begin[i + 1]); ++k) {
        sum += rows.derivative[3 * k + static_cast<std::size_t>(axis)] * values.row(rows.node[k]);
      }
      EXPECT_LT((sum - slope.row(static_cast<Eigen::Index>(i))).norm(), 1e-5 * (1 + slope.norm()));
    }
  }
}

}  // namespace brainshift::solve::visibility_test
