// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/integration_points.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve {
namespace {

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

TEST(IntegrationPoints, FillTheVolume) {
  for (const int n : {1, 8}) {
    const IntegrationPoints points = integration_points(box_cells(4, side), n, nullptr, tissues);
    EXPECT_EQ(points.size(), 64u * static_cast<std::size_t>(n));
    EXPECT_NEAR(std::accumulate(points.volume.begin(), points.volume.end(), 0.0), side * side * side, 1e-9);
  }
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

TEST(IntegrationPoints, TakeTheTissueOfTheLabelMapAndElseOfTheirCell) {
  LabelMap labels;
  labels.geometry.size = {12, 12, 12};
  labels.geometry.origin.setConstant(0.5);
  labels.voxels.assign(labels.geometry.voxel_count(), 2);
  labels.at(0, 0, 0) = 9;  // no tissue
  const IntegrationPoints points = integration_points(box_cells(12, side), 1, &labels, tissues);
  EXPECT_EQ(points.labelled_by_cell, 1u);
  EXPECT_EQ(points.label.front(), 1);
  EXPECT_EQ(std::count(points.label.begin(), points.label.end(), 2), 12 * 12 * 12 - 1);
}

/// The same but for a thin layer beyond the middle, whose octants become part of those before it.
TEST(IntegrationPoints, OfSliversAreMergedSoThatLinearFunctionsAreStillIntegrated) {
  BackgroundCells cells = cell_cut_at_a_quarter();
  InsideOctants& part = cells.cut_parts[0];
  for (const std::size_t octant : {1u, 3u, 5u, 7u}) {
    part.volume[octant] = 0.05 * side * side * side / 8;
    part.centroid[octant][0] = 0.52 * side;
    part.centroid[octant][1] = part.centroid[octant - 1][1];
    part.centroid[octant][2] = part.centroid[octant - 1][2];
  }
  const IntegrationPoints points = integration_points(cells, 8, nullptr, tissues);
  ASSERT_EQ(points.size(), 4u);
  double volume = 0, moment = 0, expected_volume = 0, expected_moment = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    volume += points.volume[i];
    moment += points.volume[i] * points.positions(static_cast<Eigen::Index>(i), 0);
  }
  for (std::size_t octant = 0; octant < 8; ++octant) {
    expected_volume += part.volume[octant];
    expected_moment += part.volume[octant] * part.centroid[octant][0];
  }
  EXPECT_NEAR(volume, expected_volume, 1e-12 * expected_volume);
  EXPECT_NEAR(moment, expected_moment, 1e-12 * expected_moment);
}

TEST(IntegrationPoints, KeepASliverThatIsAllItsTissueHas) {
  BackgroundCells cells = box_cells(2, side);
  cells.label[0] = 2;
  cells.inside_fraction[0] = 0.01;
  const IntegrationPoints points = integration_points(cells, 8, nullptr, tissues);
  EXPECT_EQ(std::count(points.label.begin(), points.label.end(), 2), 8);
}

TEST(IntegrationPoints, RefuseANumberThatTheCellsDoNotTake) {
  EXPECT_THROW(integration_points(box_cells(2, side), 4, nullptr, tissues), std::invalid_argument);
}

}  // namespace
}  // namespace brainshift::solve
