// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/gauss_points.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "solve/quadrature/cell_points.hpp"
#include "solve/quadrature/integration_points.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::gauss_points_test {

using test::box_cells;
using test::box_tetrahedra;
using test::irregular_box;

constexpr double side = 12;
const std::vector<std::int32_t> tissues = {1, 2};

double integral_of_square(const IntegrationPoints& points) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += points.volume[i] * points.positions.row(static_cast<Eigen::Index>(i)).squaredNorm();
  }
  return sum;
}

TEST(IntegrationPoints, IntegrateQuadraticsExactlyWithEightOrFourPoints) {
  const double exact = std::pow(side, 5);  // ∫ x² + y² + z²
  EXPECT_NEAR(integral_of_square(integration_points(box_cells(4, side), 8, nullptr, tissues)), exact, 1e-9 * exact);
  const NodeCloud cloud = irregular_box(5, side);
  EXPECT_NEAR(integral_of_square(integration_points(box_tetrahedra(cloud, 5), 4, nullptr, tissues)), exact,
              1e-9 * exact);
}

BackgroundCells cell_cut_at_a_quarter() {
  BackgroundCells cells = box_cells(1, side);
  cells.inside_fraction = {0.25};  // x below side/4
  cells.cut_index = {0};
  InsideOctants part{};
  for (const std::size_t octant : {0u, 2u, 4u, 6u}) {
    part.volume[octant] = side * side * side / 16;
    part.centroid[octant][0] = side / 8;
    part.centroid[octant][1] = octant & 2 ? 0.75 * side : 0.25 * side;
    part.centroid[octant][2] = octant & 4 ? 0.75 * side : 0.25 * side;
  }
  cells.cut_parts = {part};
  return cells;
}

TEST(IntegrationPoints, OfACutCellLieInItsInsidePartAndCarryItsVolume) {
  for (const int n : {1, 8}) {
    const IntegrationPoints points = integration_points(cell_cut_at_a_quarter(), n, nullptr, tissues);
    EXPECT_EQ(points.size(), n == 1 ? 1u : 4u);
    EXPECT_NEAR(std::accumulate(points.volume.begin(), points.volume.end(), 0.0), side * side * side / 4, 1e-9);
    EXPECT_LE(points.positions.col(0).maxCoeff(), side / 4);
  }
}

}  // namespace brainshift::solve::gauss_points_test
