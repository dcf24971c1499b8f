// SPDX-License-Identifier: GPL-3.0-or-later

#include "solve/quadrature/cell_boundary.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::cell_boundary_test {

constexpr double side = 60;

TEST(CellBoundary, OfHexahedraAndTetrahedraIsTheBoxOutward) {
  for (const BackgroundCells& cells :
       {test::box_cells(3, side), test::box_tetrahedra(test::irregular_box(4, side), 4)}) {
    const Surface surface = cell_boundary(cells);
    EXPECT_EQ(surface.triangles.rows(), 6 * 9 * 2);
    EXPECT_NEAR(area(surface), 6 * side * side, 1e-9 * side * side);
    EXPECT_NEAR(volume(surface), side * side * side, 1e-9 * side * side * side);
  }
}

TEST(CellBoundary, OfPlanarCellsStandsOnTheirEdges) {
  constexpr double height = 50;
  const Surface surface = cell_boundary(test::rectangle_cells(3, 2, side, height));
  EXPECT_EQ(surface.triangles.rows(), 2 * 10);
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    const Triangle strip = triangle(surface, t);
    EXPECT_EQ(strip.area_vector()[2], 0);
    EXPECT_GT(strip.area_vector().dot(strip.centroid() - Eigen::Vector3d(side / 2, height / 2, 0)), 0) << t;
  }
}

TEST(CellBoundary, OfCellsThatShareNoVertexIsTheSame) {
  BackgroundCells cells = test::box_cells(3, side);
  cells.vertices = Points(cells.vertices(cells.connectivity, Eigen::all));
  std::iota(cells.connectivity.begin(), cells.connectivity.end(), 0);
  const Surface surface = cell_boundary(cells);
  EXPECT_NEAR(area(surface), 6 * side * side, 1e-9 * side * side);
}

TEST(CellBoundary, IsUnknownWhereACellIsCut) {
  BackgroundCells cells = test::box_cells(2, side);
  cells.inside_fraction.assign(cells.size(), 1.0);
  EXPECT_GT(cell_boundary(cells).triangles.rows(), 0);
  cells.inside_fraction[3] = 0.4;
  EXPECT_EQ(cell_boundary(cells).triangles.rows(), 0);
}

}  // namespace brainshift::solve::cell_boundary_test
