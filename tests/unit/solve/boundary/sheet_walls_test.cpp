// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/sheet_walls.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/solve/sheets.hpp"

namespace brainshift::solve::sheet_walls_test {

using test::square;
using test::with_triangles;

/// Where a walker's foot is when it goes from one place to another in small steps.
std::optional<SheetWalls::Foot> walked(const SheetWalls& walls, const Eigen::Vector3d& from,
                                       const Eigen::Vector3d& to) {
  std::int32_t panel = walls.nearest_panel(from);
  std::optional<SheetWalls::Foot> foot;
  for (int i = 0; i <= 100; ++i) {
    foot = walls.foot(from + i / 100.0 * (to - from), panel);
  }
  return foot;
}

/// A roof along y with its ridge at x = 0, z = 5, that falls by `slope` to both sides.
Surface roof(double slope) {
  Surface sheet = square(5);
  sheet.vertices.col(0).array() -= 5;
  sheet.vertices.col(2) = 5 - slope * sheet.vertices.col(0).array().abs();
  return sheet;
}

TEST(SheetWalls, MeasuresFromTheSideWhereTheWalkBegan) {
  const SheetWalls walls(square(4));
  const auto above = walked(walls, {2, 3, 6}, {7, 4, 4.5}), below = walked(walls, {2, 3, 4}, {7, 4, 4.5});
  ASSERT_TRUE(above && below);
  EXPECT_NEAR(above->gap, -0.5, 1e-12);
  EXPECT_NEAR(above->normal.z(), 1, 1e-12);
  EXPECT_NEAR(below->gap, 0.5, 1e-12);
  EXPECT_NEAR(below->normal.z(), -1, 1e-12);
}

TEST(SheetWalls, HaveNoFootBeyondTheRim) {
  const SheetWalls walls(square(4));
  EXPECT_FALSE(walked(walls, {2, 3, 6}, {-0.1, 3, 6}));
  EXPECT_TRUE(walked(walls, {2, 3, 6}, {0.1, 3, 6}));
}

TEST(SheetWalls, LeadOverARidgeOnBothSides) {
  const SheetWalls walls(roof(0.5));
  const double cosine = 1 / std::hypot(1, 0.5);
  const auto outside = walked(walls, {-3, 3, 4}, {3, 3, 5}), inside = walked(walls, {-3, 3, 3}, {3, 3, 3});
  ASSERT_TRUE(outside && inside);
  EXPECT_NEAR(outside->gap, 1.5 * cosine, 1e-12);  // above the slope, which is at z = 3.5 there
  EXPECT_GT(outside->normal.x(), 0);
  EXPECT_NEAR(inside->gap, 0.5 * cosine, 1e-12);
  EXPECT_LT(inside->normal.x(), 0);
}

TEST(SheetWalls, EndAWalkThatStandsOverTheRidgeItself) {
  const SheetWalls walls(roof(0.5));
  const auto foot = walked(walls, {-3, 3, 4}, {0, 3, 5.2});  // neither slope has a foot
  ASSERT_TRUE(foot);
  EXPECT_GT(foot->gap, 0);
}

/// A floor in z = 5 and a wall on it in x = 5: three sheets meet in a line. The wall's triangles face either way.
Surface floor_with_wall(bool turned) {
  const std::int32_t n = 9;  // of the square's vertices; those of its middle line are 1, 4, 7
  Surface sheet = with_triangles(square(3), {{5, 0, 10}, {5, 10, 10}}, {{1, 4, n}, {4, n + 1, n}, {4, 7, n + 1}});
  if (turned) {
    sheet.triangles.bottomRows(3).col(1).swap(sheet.triangles.bottomRows(3).col(2));
  }
  return sheet;
}

TEST(SheetWalls, KeepAWalkerInItsCornerWhereThreeSheetsMeet) {
  for (const bool turned : {false, true}) {
    const SheetWalls walls(floor_with_wall(turned));
    const auto left = walked(walls, {3, 4, 6}, {5.3, 4, 7});
    const auto right = walked(walls, {7, 4, 6}, {4.6, 4, 7});
    const auto below = walked(walls, {3, 4, 4}, {7, 4, 5.2});
    ASSERT_TRUE(left && right && below);
    EXPECT_NEAR(left->gap, -0.3, 1e-12) << "through the wall, not over the floor beyond it";
    EXPECT_NEAR(right->gap, -0.4, 1e-12);
    EXPECT_NEAR(right->normal.x(), 1, 1e-12);
    EXPECT_NEAR(below->gap, -0.2, 1e-12) << "from below the wall is not met";
    EXPECT_NEAR(below->normal.z(), -1, 1e-12);
  }
}

}  // namespace brainshift::solve::sheet_walls_test
