// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/read_cut.hpp"

#include <gtest/gtest.h>

#include "segmentation/files/surface_file.hpp"
#include "tests/unit/expect_parts.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/sheets.hpp"

namespace brainshift::solve::read_cut_test {

using test::expect_parts;
using test::refusal;
using test::ScratchFolder;

TEST(ReadCut, TakesAPathFromACsvAndASheetFromASurface) {
  const ScratchFolder folder;
  const Cut path = read_cut(folder.write("path.csv", "x,y\n0,5\n10,5\n"), {.start = 0.5});
  EXPECT_TRUE(path.is_path());
  EXPECT_EQ(path.time, (std::vector<double>{0.5, 0.5}));
  for (const char* name : {"sheet.vtp", "sheet.stl", "sheet.ply", "sheet.obj"}) {
    write_surface(folder / name, test::square(3));
    const Cut sheet = read_cut(folder / name, {.start = 0.5});
    EXPECT_EQ(sheet.triangles.rows(), 8) << name;
    EXPECT_EQ(sheet.time, std::vector<double>(9, 0.5)) << name;
    expect_parts(sheet.name, {name});
  }
}

TEST(ReadCut, DoesNotMindCapitalsInTheEnding) {
  const ScratchFolder folder;
  EXPECT_TRUE(read_cut(folder.write("CUT.CSV", "x,y\n0,5\n10,5\n")).is_path());
  write_surface(folder / "sheet.stl", test::square(3));
  std::filesystem::rename(folder / "sheet.stl", folder / "SHEET.STL");
  EXPECT_FALSE(read_cut(folder / "SHEET.STL").is_path());
}

TEST(ReadCut, RefusesAFileThatIsNotThereOrOfAnotherKind) {
  const ScratchFolder folder;
  expect_parts(refusal([&] { read_cut(folder / "none.csv"); }), {"none.csv", "no such file"});
  expect_parts(refusal([&] { read_cut(folder / "."); }), {"no such file"});
  expect_parts(refusal([&] { read_cut(folder.write("cut.txt", "x,y\n")); }), {"cut.txt", ".csv", ".vtp, .stl"});
}

}  // namespace brainshift::solve::read_cut_test
