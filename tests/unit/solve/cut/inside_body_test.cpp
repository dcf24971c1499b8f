// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/inside_body.hpp"

#include <gtest/gtest.h>

#include "solve/quadrature/cell_points.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::inside_body_test {

constexpr double side = 20;

InsideBody inside(const BackgroundCells& cells, int points_per_cell) {
  const IntegrationPoints points = integration_points(cells, points_per_cell, nullptr, {1});
  return {points.positions, points.volume, is_planar(cells.kind)};
}

/// The share of places at random in the body that count as outside.
double missed(const BackgroundCells& cells, int points_per_cell) {
  const InsideBody is_inside = inside(cells, points_per_cell);
  constexpr int places = 2000;
  Points at = test::random_points(places, side);
  if (is_planar(cells.kind)) {
    at.col(2).setZero();
  }
  int outside = 0;
  for (const auto& x : at.rowwise()) {
    outside += is_inside(x.transpose()) ? 0 : 1;
  }
  return static_cast<double>(outside) / places;
}

TEST(InsideBody, TakesEveryPlaceBetweenThePointsOfHexahedraAndQuadrilaterals) {
  for (const int points : {1, 8}) {
    EXPECT_EQ(missed(test::box_cells(4, side), points), 0);
  }
  for (const int points : {1, 4}) {
    EXPECT_EQ(missed(test::rectangle_cells(4, 4, side, side), points), 0);
  }
}

/// The points of long cells are farther apart one way than their volumes tell.
TEST(InsideBody, TakesNearlyEveryPlaceBetweenThePointsOfTetrahedraAndTriangles) {
  const BackgroundCells tetrahedra = test::box_tetrahedra(test::irregular_box(7, side), 7);
  for (const int points : {1, 4}) {
    EXPECT_LT(missed(tetrahedra, points), 0.02);
  }
  const BackgroundCells triangles = test::rectangle_triangles(test::irregular_rectangle(7, 7, side, side), 7, 7);
  for (const int points : {1, 3}) {
    EXPECT_LT(missed(triangles, points), 0.02);
  }
}

TEST(InsideBody, CountsDistancesInTheLengthsOfLongCells) {
  const BackgroundCells cells = test::rectangle_cells(40, 5, side, side);  // 0.5 × 4 mm
  const IntegrationPoints points = integration_points(cells, 4, nullptr, {1});
  const InsideBody body(points.positions, points.volume, true, {0.5, 4, 0});
  const Points places = test::random_points(2000, side);
  for (const auto& x : places.rowwise()) {
    EXPECT_TRUE(body({x[0], x[1], 0}));
  }
  EXPECT_FALSE(body({-0.5, side / 2, 0}));
  EXPECT_FALSE(body({side / 2, -3, 0}));
  EXPECT_TRUE(body.is_within({-3, side / 2, 0}, 3));
}

/// It reaches beyond the surface by less than the distance of the points, here half a cell of 5 mm.
TEST(InsideBody, LeavesOutWhatIsFurtherOffThanThePointsAreApart) {
  const InsideBody cube = inside(test::box_cells(4, side), 8),
                   square = inside(test::rectangle_cells(4, 4, side, side), 4);
  for (const double off : {2.5, 5.0, 100.0}) {
    EXPECT_FALSE(cube({-off, side / 2, side / 2}));
    EXPECT_FALSE(cube({side / 2, side + off, side / 2}));
    EXPECT_FALSE(cube({side / 2, side / 2, side + off}));
    EXPECT_FALSE(square({-off, side / 2, 0}));
    EXPECT_FALSE(square({side / 2, side + off, 0}));
  }
}

}  // namespace brainshift::solve::inside_body_test
