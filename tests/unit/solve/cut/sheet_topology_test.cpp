// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/sheet_topology.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <tuple>
#include <utility>

#include "tests/unit/expect_parts.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/sheets.hpp"

namespace brainshift::solve::sheet_topology_test {

using test::band;
using test::expect_parts;
using test::square;
using test::with_triangles;

TEST(SheetTopology, TurnsTrianglesToAgreeWithTheFirst) {
  const Surface even = square(4);
  EXPECT_EQ(oriented_sheet(even, "sheet").triangles, even.triangles) << "nothing to turn";
  Surface mixed = even;
  for (const Eigen::Index t : {1, 4, 5, 11, 17}) {
    std::swap(mixed.triangles(t, 0), mixed.triangles(t, 1));
  }
  const Surface turned = oriented_sheet(mixed, "sheet");
  EXPECT_EQ(turned.vertices, even.vertices);
  for (const auto& t : turned.triangles.rowwise()) {
    const Eigen::Vector3d a = turned.vertices.row(t[1]) - turned.vertices.row(t[0]);
    const Eigen::Vector3d b = turned.vertices.row(t[2]) - turned.vertices.row(t[0]);
    EXPECT_GT(a.cross(b).z(), 0);
  }
}

TEST(SheetTopology, KeepsTheSideOfTheFirstTriangle) {
  Surface sheet = square(3);
  std::swap(sheet.triangles(0, 1), sheet.triangles(0, 2));
  const Surface turned = oriented_sheet(sheet, "sheet");
  EXPECT_EQ(turned.triangles.row(0), sheet.triangles.row(0));
  EXPECT_NE(turned.triangles.row(1), sheet.triangles.row(1));
}

TEST(SheetTopology, RefusesWhatCannotBeCutAlong) {
  const auto in_middle = [](int i, int j) { return i == 2 && j == 2; };
  const auto diagonal = [](int i, int j) { return (i == 0) != (j == 0); };
  // A ring of squares whose corner is missing too: two of them meet in the vertex between the gaps.
  const auto corner_gap = [](int i, int j) { return i == j && i > 0; };
  const Surface tetrahedron =
      with_triangles({Points(0, 3), Triangles(0, 3)}, {{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}},
                     {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  const std::tuple<const char*, Surface, std::vector<std::string>> cases[] = {
      {"twice a vertex", with_triangles(square(2), {}, {{0, 1, 1}}), {"triangle 3", "no area"}},
      {"no area", with_triangles(square(2), {{20, 0, 5}}, {{0, 1, 4}}), {"triangle 3", "no area"}},
      {"branching",
       with_triangles(square(2), {{5, 5, 12}}, {{0, 3, 4}}),
       {"3 triangles", "(5, 5, 5)", "cut of its own"}},
      {"pieces",
       with_triangles(square(2), {{20, 0, 5}, {30, 0, 5}, {30, 9, 5}}, {{4, 5, 6}}),
       {"pieces", "(20, 0, 5)"}},
      {"one-sided", band(12, 1), {"one side only"}},
      {"pieces that share a vertex", square(3, diagonal), {"pieces"}},
      {"parts that hang together by a vertex", square(4, corner_gap), {"one vertex only", "6.66667, 6.66667"}},
      {"closed", tetrahedron, {"closed", "resection"}},
      {"a ring", band(12, 0), {"hole"}},
      {"a ring with a full turn", band(12, 2), {"hole"}},
      {"a hole", square(6, in_middle), {"hole", "rim 8 mm", "(5, 5, 5)"}},
  };
  for (const auto& [what, sheet, parts] : cases) {
    SCOPED_TRACE(what);
    const std::string fault = test::refusal([&, &given = sheet] { oriented_sheet(given, "sheet 7"); });
    expect_parts(fault, parts);
    expect_parts(fault, {"sheet 7: "});
  }
}

}  // namespace brainshift::solve::sheet_topology_test
