// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cells/cell_grid.hpp"

#include <gtest/gtest.h>

namespace brainshift::discretise::cell_grid_test {

/// A box of 2 × 3 × 5 in VTK's order of corners.
Points box_corners() {
  Points corners(8, 3);
  corners << 0, 0, 0, 2, 0, 0, 2, 3, 0, 0, 3, 0, 0, 0, 5, 2, 0, 5, 2, 3, 5, 0, 3, 5;
  return corners;
}

BackgroundCells cells(CellKind kind, const std::vector<std::int32_t>& connectivity,
                      const std::vector<double>& fractions) {
  BackgroundCells result;
  result.kind = kind;
  result.vertices = box_corners();
  result.connectivity = connectivity;
  result.inside_fraction = fractions;
  return result;
}

TEST(InsideVolume, OfHexahedraIsTheirFractionOfTheBox) {
  EXPECT_DOUBLE_EQ(inside_volume(cells(CellKind::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7}, {1})), 30);
  const std::vector<std::int32_t> twice = {0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7};
  EXPECT_DOUBLE_EQ(inside_volume(cells(CellKind::hexahedron, twice, {0.5, 0.2})), 21);
}

TEST(InsideVolume, OfTheFiveTetrahedraOfABoxIsTheBoxs) {
  const std::vector<std::int32_t> five = {0, 1, 2, 5, 0, 2, 3, 7, 0, 5, 7, 4, 2, 7, 5, 6, 0, 2, 7, 5};
  EXPECT_DOUBLE_EQ(inside_volume(cells(CellKind::tetrahedron, five, std::vector<double>(5, 1))), 30);
  EXPECT_DOUBLE_EQ(inside_volume(cells(CellKind::tetrahedron, {0, 1, 2, 5}, {0.5})), 2.5);
}

TEST(InsideVolume, OfNoCellsIsNothing) {
  EXPECT_EQ(inside_volume({}), 0);
}

}  // namespace brainshift::discretise::cell_grid_test
