// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/point_extents.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solve/quadrature/cell_points.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::point_extents_test {

const Eigen::Vector3d up(0, 0, 1), up_in_plane(0, 1, 0);

/// Of the points' boxes, mm³.
double volume_above(double level, const Eigen::Vector3d& direction, const BackgroundCells& cells, int points_per_cell) {
  const IntegrationPoints points = integration_points(cells, points_per_cell, nullptr, {1});
  const PointExtents extents = extents_along(direction, cells, points);
  double above = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double top = extents.middle[i] + extents.edge[i] / 2 - level;
    above += points.volume[i] * std::clamp(top / extents.edge[i], 0.0, 1.0);
  }
  return above;
}

TEST(PointExtents, OfBricksAreThoseOfTheirOctantsWhateverTheirShape) {
  for (const Eigen::Vector3i& count : {Eigen::Vector3i(12, 12, 4), {2, 2, 40}, {3, 5, 7}}) {
    const BackgroundCells cells = test::box_cells(count, {20, 20, 40});
    for (const double level : {1.3, 17.0, 35.1, 39.5}) {
      for (const int points : {1, 8}) {
        EXPECT_NEAR(volume_above(level, up, cells, points), 400 * (40 - level), 1e-6) << count.transpose();
      }
    }
  }
}

TEST(PointExtents, OfAPlaneDoNotDependOnItsScale) {
  for (const double scale : {1.0, 0.01}) {
    const BackgroundCells cells = test::rectangle_cells(8, 8, 40 * scale, 40 * scale);
    for (const double level : {7.7, 38.0, 39.2}) {
      for (const int points : {1, 4}) {
        EXPECT_NEAR(volume_above(level * scale, up_in_plane, cells, points), scale * scale * 40 * (40 - level),
                    1e-9 * scale * scale);
      }
    }
  }
}

TEST(PointExtents, OfSimplicesAndOfTurnedCubesHoldTheVolumeAboveALevel) {
  constexpr double side = 40;
  constexpr int n = 9;
  const NodeCloud box = test::irregular_box(n, side), rectangle = test::irregular_rectangle(n, n, side, side);
  const BackgroundCells tetrahedra = test::box_tetrahedra(box, n);
  const BackgroundCells triangles = test::rectangle_triangles(rectangle, n, n);
  for (const double level : {11.0, 34.0, 37.5}) {
    for (const int points : {1, 4}) {
      const double exact = side * side * (side - level);
      EXPECT_NEAR(volume_above(level, up, tetrahedra, points) / exact, 1, 0.015) << level << ", " << points;
    }
    for (const int points : {1, 3}) {
      const double exact = side * (side - level);
      EXPECT_NEAR(volume_above(level, up_in_plane, triangles, points) / exact, 1, 0.015) << level << ", " << points;
    }
  }
  const Eigen::Vector3d diagonal = Eigen::Vector3d(1, 1, 1).normalized();
  const double depth = 20;  // below the corner: the plane cuts off a corner of depth³ √3 / 2
  EXPECT_NEAR(volume_above(std::sqrt(3) * side - depth, diagonal, test::box_cells(n - 1, side), 8) /
                  (std::sqrt(3) / 2 * std::pow(depth, 3)),
              1, 0.01);
}

TEST(PointExtents, OfAPartOfACellAreAboutItsPoints) {
  BackgroundCells cells = test::box_cells(1, 8);
  const IntegrationPoints whole = integration_points(cells, 8, nullptr, {1});
  IntegrationPoints part = whole;
  part.positions = whole.positions.topRows(4).eval();
  part.volume.resize(4);
  part.cell.resize(4);
  const PointExtents of_whole = extents_along(up, cells, whole), of_part = extents_along(up, cells, part);
  EXPECT_NEAR(of_whole.middle[0], 2, 1e-12);
  EXPECT_NEAR(of_part.middle[0], 4 - 4 / std::sqrt(3), 1e-12);
  EXPECT_NEAR(of_part.edge[0], 4, 1e-12);
}

}  // namespace brainshift::solve::point_extents_test
