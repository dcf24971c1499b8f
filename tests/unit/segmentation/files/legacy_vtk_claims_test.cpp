// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/legacy_vtk_claims.hpp"

#include <gtest/gtest.h>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::test::legacy_vtk_claims_test {

std::string file_of(const std::string& form, const std::string& cells) {
  return "# vtk DataFile Version 3.0\ntracts\n" + form + "\nDATASET POLYDATA\nPOINTS 2 float\n" + cells;
}

std::string said_of(const std::string& text) {
  const ScratchFolder folder;
  return refusal([&] { check_legacy_vtk_claims(folder.write("in.vtk", text)); });
}

TEST(LegacyVtkClaims, WholeCellsPassInTextAndBytes) {
  using namespace std::string_literals;
  EXPECT_EQ(said_of(file_of("ASCII", "LINES 2 6\n2 0 1\n2 1 0\nVERTICES 1 2\n1 0\n")), "");
  EXPECT_EQ(said_of(file_of("BINARY", "LINES 1 3\n\0\0\0\2\0\0\0\0\0\0\0\1\n"s)), "");
  EXPECT_EQ(said_of(file_of("ASCII", "")), "");
}

TEST(LegacyVtkClaims, CellsOfOtherLengthAreRefusedByName) {
  using namespace std::string_literals;
  for (const char* cells : {"LINES 2 6\n2 0 1\n", "LINES 1 7\n2 0 1\n", "LINES 1 3\n9 0 1\n", "LINES -1 3\n2 0 1\n",
                            "POLYGONS x 3\n2 0 1\n"}) {
    EXPECT_NE(said_of(file_of("ASCII", cells)).find("in.vtk: its cells"), std::string::npos) << cells;
  }
  EXPECT_NE(said_of(file_of("BINARY", "LINES 1 3\n\0\0\0\2\0\0\0\0\0\0"s)).find("in.vtk: its cells"),
            std::string::npos);
}

}  // namespace brainshift::test::legacy_vtk_claims_test
