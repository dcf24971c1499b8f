// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/cut_patches.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/solve/cut_bodies.hpp"

namespace brainshift::solve::cut_patches_test {

/// Places of a grid 1 mm apart, 8 × 8 from (0.5, 0.5), in patches of 2 × 2.
struct Grid {
  Points positions = Points(64, 3);
  PressurePatches patches;

  Grid() {
    patches.begin.push_back(0);
    for (int k = 0; k < 64; ++k) {
      const int patch = k / 4, x = 2 * (patch % 4) + k % 2, y = 2 * (patch / 4) + k / 2 % 2;
      positions.row(k) << x + 0.5, y + 0.5, 0;
      patches.order.push_back(k);
      if (k % 4 == 3) {
        patches.begin.push_back(k + 1);
      }
    }
  }
};

TEST(CutPatches, ThatACutDoesNotMeetStayAsTheyAre) {
  const Grid grid;
  const Visibility between(test::path({{-1, 4}, {9, 4}}, false)), beside(test::path({{-3, 0}, {-3, 8}}, false));
  for (const Visibility* cut : {&between, &beside}) {
    const PressurePatches parted = part_patches(*cut, grid.positions, grid.patches);
    EXPECT_EQ(parted.begin, grid.patches.begin);
    EXPECT_EQ(parted.order, grid.patches.order);
  }
}

TEST(CutPatches, AreOnOneSideEach) {
  const Grid grid;
  const Visibility cut(test::path({{-1, 3}, {9, 3}}, false));  // through the second row of patches
  const PressurePatches parted = part_patches(cut, grid.positions, grid.patches);
  EXPECT_EQ(parted.size(), grid.patches.size() + 4);
  std::vector<std::int32_t> all = parted.order;
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, grid.patches.order) << "each point once";
  for (std::size_t i = 0; i < parted.size(); ++i) {
    const double y = grid.positions(parted.order[static_cast<std::size_t>(parted.begin[i])], 1);
    for (auto k = static_cast<std::size_t>(parted.begin[i]); k < static_cast<std::size_t>(parted.begin[i + 1]); ++k) {
      EXPECT_EQ(grid.positions(parted.order[k], 1) > 3, y > 3);
    }
  }
}

TEST(CutPatches, StayWholeWhereTheirPointsSeeEachOtherOverOthers) {
  Grid grid;
  grid.patches.begin = {0, 64};  // one patch
  const Visibility notch(test::path({{-1, 3}, {4, 3}}, true));
  EXPECT_EQ(part_patches(notch, grid.positions, grid.patches).size(), 1U) << "round the tip";
  const Visibility corner(test::path({{-1, 2}, {2, 2}, {2, -1}}, false));
  const PressurePatches parted = part_patches(corner, grid.positions, grid.patches);
  ASSERT_EQ(parted.size(), 2U);
  EXPECT_EQ(std::min(parted.begin[1], 64 - parted.begin[1]), 4) << "the corner's four points";
}

}  // namespace brainshift::solve::cut_patches_test
