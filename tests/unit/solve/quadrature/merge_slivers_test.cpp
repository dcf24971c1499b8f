// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/merge_slivers.hpp"

#include <gtest/gtest.h>

#include "solve/quadrature/cell_points.hpp"
#include "solve/quadrature/integration_points.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/unit/solve/quarter_cell.hpp"

namespace brainshift::solve::merge_slivers_test {

using test::box_cells;

constexpr double side = 12;
const std::vector<std::int32_t> tissues = {1, 2};

/// The same but for a thin layer beyond the middle, whose octants become part of those before it.
TEST(IntegrationPoints, OfSliversAreMergedSoThatLinearFunctionsAreStillIntegrated) {
  BackgroundCells cells = test::cell_cut_at_a_quarter(side);
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

TEST(IntegrationPoints, KeepASliverThatIsFarFromTheRestOfItsTissue) {
  BackgroundCells cells = box_cells(6, 6 * side);
  cells.label.front() = cells.label.back() = 2;
  cells.inside_fraction.back() = 0.01;
  const IntegrationPoints points = integration_points(cells, 8, nullptr, tissues);
  int far = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (points.label[p] == 2) {
      const Eigen::RowVector3d x = points.positions.row(static_cast<Eigen::Index>(p));
      EXPECT_TRUE(x.maxCoeff() < side || x.minCoeff() > 5 * side) << x;
      far += x.minCoeff() > 5 * side ? 1 : 0;
    }
  }
  EXPECT_EQ(far, 8);
}

}  // namespace brainshift::solve::merge_slivers_test
