// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/cell_points.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "solve/quadrature/integration_points.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::cell_points_planar_test {

using test::irregular_rectangle;
using test::rectangle_cells;
using test::rectangle_triangles;

constexpr double width = 12, height = 8;  // mm; the thickness is 1 mm
const std::vector<std::int32_t> tissues = {1, 2};

IntegrationPoints points_of(const BackgroundCells& cells, int points_per_cell) {
  return integration_points(cells, points_per_cell, nullptr, tissues);
}

BackgroundCells triangles() {
  return rectangle_triangles(irregular_rectangle(6, 5, width, height), 6, 5);
}

/// The cells of a rectangle with their inner vertices moved: quadrilaterals of any shape.
BackgroundCells skew_quadrilaterals() {
  BackgroundCells cells = rectangle_cells(5, 4, width, height);
  cells.vertices = irregular_rectangle(6, 5, width, height, 0.2).positions;
  return cells;
}

double volume(const IntegrationPoints& points) {
  return std::accumulate(points.volume.begin(), points.volume.end(), 0.0);
}

/// ∫ (x − y)², which on the rectangle is known.
double integral(const IntegrationPoints& points) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto x = points.positions.row(static_cast<Eigen::Index>(i));
    sum += points.volume[i] * std::pow(x[0] - x[1], 2);
  }
  return sum;
}

constexpr double exact =
    width * height * (width * width / 3 - width * height / 2 + height * height / 3);  // of the integral above

TEST(PlanarIntegrationPoints, FillTheAreaTimesAThicknessOfOneMillimetre) {
  for (const BackgroundCells& cells : {rectangle_cells(5, 4, width, height), skew_quadrilaterals(), triangles()}) {
    for (const int n : {1, most_points_per_cell(cells.kind)}) {
      const IntegrationPoints points = points_of(cells, n);
      EXPECT_EQ(points.size(), cells.size() * static_cast<std::size_t>(n));
      EXPECT_NEAR(volume(points), width * height, 1e-10);
      EXPECT_GT(*std::min_element(points.volume.begin(), points.volume.end()), 0);
      EXPECT_TRUE((points.positions.col(2).array() == 0).all());
    }
  }
}

TEST(PlanarIntegrationPoints, IntegrateQuadraticsExactlyWithFourOrThreePoints) {
  EXPECT_NEAR(integral(points_of(rectangle_cells(5, 4, width, height), 4)), exact, 1e-10 * exact);
  EXPECT_NEAR(integral(points_of(skew_quadrilaterals(), 4)), exact, 1e-10 * exact);
  EXPECT_NEAR(integral(points_of(triangles(), 3)), exact, 1e-10 * exact);
  EXPECT_GT(std::abs(integral(points_of(triangles(), 1)) - exact), 1e-3 * exact);  // the test can tell
}

TEST(PlanarIntegrationPoints, CountWithTheirInsideFraction) {
  for (BackgroundCells cells : {rectangle_cells(5, 4, width, height), triangles()}) {
    cells.inside_fraction.assign(cells.size(), 0.25);
    for (const int n : {1, most_points_per_cell(cells.kind)}) {
      EXPECT_NEAR(volume(points_of(cells, n)), width * height / 4, 1e-10);
    }
  }
}

TEST(PlanarIntegrationPoints, RefuseANumberThatTheCellsDoNotTake) {
  for (const int n : {0, 2, 3, 8}) {
    EXPECT_THROW(points_of(rectangle_cells(2, 2, width, height), n), std::invalid_argument) << n;
  }
  for (const int n : {0, 2, 4, 8}) {
    EXPECT_THROW(points_of(triangles(), n), std::invalid_argument) << n;
  }
}

}  // namespace brainshift::solve::cell_points_planar_test
