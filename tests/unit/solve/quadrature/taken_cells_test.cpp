// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/taken_cells.hpp"

#include <gtest/gtest.h>

#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::taken_cells_test {

/// Eight hexahedra of labels 0 to 7; those of odd labels are cut, each into a first octant of its label as volume.
BackgroundCells some_cells() {
  BackgroundCells cells = test::box_cells(2, 20);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells.label[i] = static_cast<std::int32_t>(i);
    cells.inside_fraction[i] = 1 - 0.1 * static_cast<double>(i);
    cells.cut_index.push_back(i % 2 == 0 ? -1 : static_cast<std::int32_t>(cells.cut_parts.size()));
    if (i % 2 != 0) {
      cells.cut_parts.push_back({});
      cells.cut_parts.back().volume[0] = static_cast<double>(i);
    }
  }
  return cells;
}

TEST(TakenCells, KeepAllThatBelongsToEachCell) {
  const BackgroundCells cells = some_cells();
  const std::vector<std::uint8_t> taken = {0, 1, 1, 0, 0, 0, 2, 1};
  const BackgroundCells part = taken_cells(cells, taken, 1);
  EXPECT_EQ(part.label, (std::vector<std::int32_t>{1, 2, 7}));
  EXPECT_EQ(part.kind, cells.kind);
  EXPECT_EQ(part.vertices, cells.vertices);
  EXPECT_EQ(part.cut_index, (std::vector<std::int32_t>{0, -1, 1}));
  ASSERT_EQ(part.cut_parts.size(), 2U);
  EXPECT_EQ(part.cut_parts[1].volume[0], 7);
  for (std::size_t i = 0; i < part.size(); ++i) {
    const auto from = static_cast<std::size_t>(part.label[i]);
    EXPECT_EQ(part.inside_fraction[i], cells.inside_fraction[from]);
    for (std::size_t corner = 0; corner < 8; ++corner) {
      EXPECT_EQ(part.connectivity[8 * i + corner], cells.connectivity[8 * from + corner]);
    }
  }
}

TEST(TakenCells, OfEachKindAreAllTogether) {
  const BackgroundCells cells = some_cells();
  const std::vector<std::uint8_t> taken = {0, 1, 1, 0, 0, 0, 2, 1};
  std::size_t count = 0, corners = 0, parts = 0;
  for (std::uint8_t which = 0; which < 4; ++which) {
    const BackgroundCells part = taken_cells(cells, taken, which);
    count += part.size();
    corners += part.connectivity.size();
    parts += part.cut_parts.size();
  }
  EXPECT_EQ(count, 8U);
  EXPECT_EQ(corners, 64U);
  EXPECT_EQ(parts, 4U);
}

TEST(TakenCells, OfAWholeBodyHaveNoCutParts) {
  const NodeCloud cloud = test::irregular_rectangle(3, 3, 10, 10);
  const BackgroundCells cells = test::rectangle_triangles(cloud, 3, 3);
  const BackgroundCells part = taken_cells(cells, std::vector<std::uint8_t>{1, 0, 0, 0, 0, 0, 0, 1}, 1);
  EXPECT_EQ(part.size(), 2U);
  EXPECT_EQ(part.connectivity.size(), 6U);
  EXPECT_TRUE(part.cut_index.empty());
}

}  // namespace brainshift::solve::taken_cells_test
