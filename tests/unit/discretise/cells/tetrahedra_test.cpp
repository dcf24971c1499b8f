// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "discretise/discretise.hpp"
#include "tests/unit/discretise/bodies.hpp"

namespace brainshift::discretise::tetrahedra_test {

using test::ball;
using test::bumpy_brain;
using test::with_nodes;
const Eigen::Vector3d centre(30, -210, 55);

Eigen::Matrix<double, 4, 3> tetrahedron(const BackgroundCells& cells, std::size_t cell) {
  Eigen::Matrix<double, 4, 3> x;
  for (std::size_t k = 0; k < 4; ++k) {
    x.row(static_cast<Eigen::Index>(k)) = cells.vertices.row(cells.connectivity[4 * cell + k]);
  }
  return x;
}

TEST(Tetrahedra, AreAllPositiveWithTheNodesForVertices) {
  const Discretisation result = with_nodes(bumpy_brain(), 3000, CellKind::tetrahedron);
  EXPECT_EQ(result.cells.vertices, result.cloud.positions);
  ASSERT_GT(result.cells.size(), 10000U);
  for (std::size_t cell = 0; cell < result.cells.size(); ++cell) {
    const Eigen::Matrix<double, 4, 3> x = tetrahedron(result.cells, cell);
    EXPECT_GT((x.bottomRows<3>().rowwise() - x.row(0)).eval().determinant(), 0);
    EXPECT_EQ(result.cells.inside_fraction[cell], 1.0);
  }
  EXPECT_TRUE(result.cells.cut_parts.empty());
}

TEST(Tetrahedra, ApproachTheVolumeOfABallAsTheyGetSmaller) {
  const double exact = 4.0 / 3.0 * std::numbers::pi * std::pow(40, 3);
  double previous = 1;
  for (const std::size_t nodes : {250U, 2000U, 16000U}) {
    const Discretisation result = with_nodes(ball(40, centre, 6), nodes, CellKind::tetrahedron);
    const double error = std::abs(result.measures.cells_inside_volume / exact - 1);
    EXPECT_LT(error, 0.4 * previous) << nodes;  // second order: a quarter for each halving of the spacing
    previous = error;
  }
  EXPECT_LT(previous, 5e-3);
}

TEST(Tetrahedra, OfABrainHoldItsVolume) {
  const Discretisation result = with_nodes(bumpy_brain(), 8000, CellKind::tetrahedron);
  EXPECT_NEAR(result.measures.cells_inside_volume / result.measures.surface_volume, 1.0, 5e-3);
}

}  // namespace brainshift::discretise::tetrahedra_test
