// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/self_crossing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solve/cut/sheet_topology.hpp"
#include "tests/unit/solve/sheets.hpp"

namespace brainshift::solve::self_crossing_test {

using Pair = std::pair<std::size_t, std::size_t>;

TEST(SelfCrossing, OfAPathIsFoundWithItsTwoSegments) {
  EXPECT_EQ(meeting_segments({{0, 0}, {2, 0}, {2, 2}, {1, -1}}), Pair(0, 2)) << "crosses";
  EXPECT_EQ(meeting_segments({{0, 0}, {4, 0}, {4, 2}, {2, 0}}), Pair(0, 2)) << "touches from the side";
  EXPECT_EQ(meeting_segments({{0, 0}, {4, 0}, {4, 2}, {0, 0}}), Pair(0, 2)) << "comes back to its start";
  EXPECT_EQ(meeting_segments({{0, 0}, {4, 0}, {3, 0}}), Pair(0, 1)) << "goes back over itself";
  EXPECT_EQ(meeting_segments({{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 0}, {0.5, 0}}), Pair(0, 4)) << "lies on a part";
}

TEST(SelfCrossing, OfAPathIsNoneWhereItOnlyBendsOrComesNear) {
  EXPECT_FALSE(meeting_segments({{0, 0}, {1, 0}, {2, 0}, {3, 0}})) << "straight on";
  EXPECT_FALSE(meeting_segments({{0, 0}, {4, 0}, {4, 2}, {2, 1e-15}}));
  EXPECT_FALSE(meeting_segments({{0, 0}, {1, 5}, {2, 0}, {3, 5}}));
  EXPECT_FALSE(meeting_segments({{0, 0}, {1, 0}}));
}

/// Whether points are on a line is decided exactly: a tenth of these steps is not a number that doubles hold.
TEST(SelfCrossing, OfAPathIsExact) {
  const double a = 0.1, b = 0.7, c = 0.3;
  EXPECT_TRUE(meeting_segments({{a, a}, {b, b}, {c, c}})) << "back on the diagonal";
  EXPECT_FALSE(meeting_segments({{a, a}, {b, b}, {c, std::nextafter(c, 1)}})) << "next to it by one bit";
}

TEST(SelfCrossing, OfASheetIsFoundWithItsTwoTriangles) {
  EXPECT_FALSE(meeting_triangles(test::square(5)));
  const auto crossing = meeting_triangles(oriented_sheet(test::crossing_itself(), "sheet"));
  ASSERT_TRUE(crossing);
  EXPECT_NE(crossing->first, crossing->second);
  EXPECT_GE(std::max(crossing->first, crossing->second), 2U) << "not the two of the square";
  const auto folded = meeting_triangles(oriented_sheet(test::folded_back(), "sheet"));
  ASSERT_TRUE(folded);
  EXPECT_EQ(std::max(folded->first, folded->second), 2U);
}

/// A band that bends round to a thousandth of a millimetre of where it began.
TEST(SelfCrossing, OfASheetIsNoneWhereItComesNear) {
  Surface sheet = test::band(12, 0);
  sheet.vertices.conservativeResize(26, Eigen::NoChange);
  sheet.vertices.row(24) = 1.0001 * sheet.vertices.row(0);
  sheet.vertices.row(25) = 1.0001 * sheet.vertices.row(1);
  for (auto& v : sheet.triangles.bottomRows<2>().reshaped()) {
    v = v == 0 ? 24 : v == 1 ? 25 : v;
  }
  EXPECT_FALSE(meeting_triangles(sheet));
  sheet.vertices.row(24) = 0.9 * sheet.vertices.row(2);
  sheet.vertices.row(25) = 1.1 * sheet.vertices.row(3);
  EXPECT_TRUE(meeting_triangles(sheet)) << "through the first of its quadrilaterals";
}

}  // namespace brainshift::solve::self_crossing_test
