// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/read_obj.hpp"

#include <gtest/gtest.h>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::test::read_obj_test {

using Corners = std::vector<std::size_t>;

const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

PolygonSoup read(const std::string& text) {
  const ScratchFolder folder;
  return read_obj(folder.write("a.obj", text));
}

std::string fault(const std::string& text) {
  return refusal([&] { read(text); });
}

TEST(ReadObj, KeepsEveryBitOfACoordinate) {
  const PolygonSoup soup = read("v 0.1 -1e-17 123456.7890123\n");
  ASSERT_EQ(soup.points.size(), 1U);
  EXPECT_EQ(soup.points[0], (std::array{0.1, -1e-17, 123456.7890123}));
}

TEST(ReadObj, ACornerIsItsVertexWhateverItSaysOfTextureAndNormal) {
  for (const char* const face : {"f 1 2 3 4", "f 1/7 2/7 3/7 4/7", "f 1/7/9 2/8/9 3/7/9 4/8/9", "f 1//9 2//9 3//9 4//9",
                                 "f 1 2 3 4 # a square", "f\t1  2\t3 4"}) {
    EXPECT_EQ(read(corners + face + "\n").polygons, (std::vector<Corners>{{0, 1, 2, 3}})) << face;
  }
}

TEST(ReadObj, ANegativeNumberCountsBackFromTheLastVertexReadSoFar) {
  const PolygonSoup soup = read("v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 5 5 5\nf -1 1 -2\n");
  EXPECT_EQ(soup.polygons, (std::vector<Corners>{{0, 1, 2}, {3, 0, 2}}));
}

TEST(ReadObj, WhatIsNeitherVertexNorFaceIsPassedOver) {
  const PolygonSoup soup =
      read("# by hand\nmtllib a.mtl\no head\n\nvn 0 0 1\nvt 0 0\ns off\nusemtl skin\r\n" + corners);
  EXPECT_EQ(soup.points.size(), 4U);
  EXPECT_TRUE(soup.polygons.empty());
}

TEST(ReadObj, AStatementGoesOnBehindABackslash) {
  EXPECT_EQ(read(corners + "f 1 2 \\\n  3 \\\n4\n").polygons, (std::vector<Corners>{{0, 1, 2, 3}}));
  EXPECT_NE(fault(corners + "f 1 2 \\\n3 4\nf 1 2\n").find("a.obj:7: expected a face"), std::string::npos);
}

TEST(ReadObj, WhatDoesNotParseIsNamedWithItsLine) {
  EXPECT_NE(fault("v 0 0 0\nv 1,5 0 0\n").find("a.obj:2"), std::string::npos);
  EXPECT_NE(fault("v 0 0 0\nv 1,5 0 0\n").find("1,5"), std::string::npos);
  EXPECT_NE(fault("v 0 0\n").find("a.obj:1"), std::string::npos);
  for (const char* const face : {"f 1 2", "f 1 2 three", "f 0 1 2", "f 1 2 -5", "f 1 2 3.5", "f"}) {
    EXPECT_NE(fault(corners + face + "\n").find("a.obj:5: expected a face"), std::string::npos) << face;
  }
  EXPECT_NE(fault("v 0 0 0\n1 2 3\n").find("a.obj:2: expected a statement"), std::string::npos);
}

}  // namespace brainshift::test::read_obj_test
