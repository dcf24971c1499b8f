// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/gauss_points.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "solve/quadrature/cell_points.hpp"
#include "solve/quadrature/integration_points.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/unit/solve/quarter_cell.hpp"

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

TEST(IntegrationPoints, OfACutCellLieInItsInsidePartAndCarryItsVolume) {
  for (const int n : {1, 8}) {
    const IntegrationPoints points = integration_points(test::cell_cut_at_a_quarter(side), n, nullptr, tissues);
    EXPECT_EQ(points.size(), n == 1 ? 1u : 4u);
    EXPECT_NEAR(std::accumulate(points.volume.begin(), points.volume.end(), 0.0), side * side * side / 4, 1e-9);
    EXPECT_LE(points.positions.col(0).maxCoeff(), side / 4);
  }
}

}  // namespace brainshift::solve::gauss_points_test
