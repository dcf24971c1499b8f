// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/convex_hull.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace brainshift::solve::convex_hull_test {

PlanePoints places(std::initializer_list<Eigen::RowVector2d> rows) {
  PlanePoints points(static_cast<Eigen::Index>(rows.size()), 2);
  Eigen::Index n = 0;
  for (const Eigen::RowVector2d& row : rows) {
    points.row(n++) = row;
  }
  return points;
}

const PlanePoints square_and_more = places({{1, 1}, {0, 0}, {2, 2}, {1, 0}, {2, 0}, {0, 2}, {2, 0}, {0.5, 1.5}});

double twice_area(const std::vector<Eigen::Vector2d>& corners) {
  double sum = 0;
  for (std::size_t n = 0; n < corners.size(); ++n) {
    const Eigen::Vector2d &a = corners[n], &b = corners[(n + 1) % corners.size()];
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

TEST(ConvexHull, HasTheCornersAloneCounterClockwise) {
  const auto hull = convex_hull(square_and_more);
  EXPECT_EQ(hull.size(), 4U) << "neither places inside, nor on a side, nor the same again";
  EXPECT_EQ(twice_area(hull), 8) << "positive: counter-clockwise";
}

TEST(ConvexHull, DegeneratesToALineAndAPlace) {
  const auto line = convex_hull(places({{1, 1}, {0, 0}, {3, 3}, {2, 2}}));
  ASSERT_EQ(line.size(), 2U);
  EXPECT_DOUBLE_EQ((line[0] - line[1]).norm(), 3 * std::sqrt(2.0));
  EXPECT_EQ(convex_hull(places({{1, 1}, {1, 1}})).size(), 1U);
}

TEST(ConvexHull, IsNearestAtAPlaceItselfInsideAndOnTheNearestSideOutside) {
  using Place = Eigen::Vector2d;
  const auto hull = convex_hull(square_and_more);
  EXPECT_EQ(nearest_of_hull(hull, {1.9, 0.1}), Place(1.9, 0.1));
  EXPECT_EQ(nearest_of_hull(hull, {2, 1}), Place(2, 1)) << "on a side";
  EXPECT_EQ(nearest_of_hull(hull, {3, 1}), Place(2, 1));
  EXPECT_EQ(nearest_of_hull(hull, {-3, 6}), Place(0, 2)) << "a corner";
  const auto line = convex_hull(places({{0, 0}, {2, 0}}));
  EXPECT_EQ(nearest_of_hull(line, {1, 0.5}), Place(1, 0));
  EXPECT_EQ(nearest_of_hull(convex_hull(places({{1, 1}})), {4, 5}), Place(1, 1));
}

}  // namespace brainshift::solve::convex_hull_test
