// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/point_table.hpp"

#include <gtest/gtest.h>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::test::point_table_test {

const std::string header = "# frame: LPS\nx,y,z\n";

std::string fault(const std::string& text, const std::string& name = "t.csv") {
  const ScratchFolder folder;
  const auto file = folder.write(name, text);
  return refusal([&] {
    const PointTable table = read_point_table(file);
    vectors_in(table, "x", "y", "z");
  });
}

TEST(PointTable, FindsItsColumnsByTheirNamesInAnyOrder) {
  const ScratchFolder folder;
  const PointTable table = read_point_table(
      folder.write("t.csv", "# by hand\n# frame: LPS\nuz, z ,y,x,name\n9,3,2,1,a\n\n8,6,5,4,\"b, c\"\n"));
  Points places(2, 3);
  places << 1, 2, 3, 4, 5, 6;
  EXPECT_EQ(vectors_in(table, "x", "y", "z"), places);
  EXPECT_EQ(texts_in(table, "name"), (std::vector<std::string>{"a", "b, c"}));
  EXPECT_EQ(table.find_column("uz"), 0U);
  EXPECT_FALSE(table.find_column("ux"));
}

TEST(PointTable, InRasIsTurnedToLps) {
  const ScratchFolder folder;
  for (const char* const frame : {"# frame: RAS", "# CoordinateSystem = RAS", "# CoordinateSystem = 0"}) {
    const PointTable table = read_point_table(folder.write("t.csv", std::string(frame) + "\nx,y,z\n1,2,3\n"));
    EXPECT_EQ(vectors_in(table, "x", "y", "z"), Eigen::RowVector3d(-1, -2, 3)) << frame;
  }
}

TEST(PointTable, MustNameOneFrame) {
  EXPECT_EQ(fault("# frame: LPS\n# frame: 1\nx,y,z\n1,2,3\n"), "");
  EXPECT_NE(fault("x,y,z\n1,2,3\n").find("# frame: LPS"), std::string::npos);
  EXPECT_NE(fault("1,1,2,3\n", "t.fcsv").find("CoordinateSystem"), std::string::npos);
  EXPECT_NE(fault("# frame: LPS\n# frame: RAS\nx,y,z\n1,2,3\n").find("t.csv:2: the frame is named twice"),
            std::string::npos);
  EXPECT_NE(fault("# frame: lps\nx,y,z\n1,2,3\n").find("found \"lps\""), std::string::npos);
}

TEST(PointTable, WhatDoesNotParseIsNamedWithItsLine) {
  EXPECT_NE(fault("# frame: LPS\nx,y\n1,2\n").find("t.csv:2: a header"), std::string::npos);
  EXPECT_NE(fault("# frame: LPS\n1,2,3\n").find("t.csv:2: a header"), std::string::npos);
  EXPECT_NE(fault(header + "1,2,3\n1,2\n").find("t.csv:4: 3 columns"), std::string::npos);
  EXPECT_NE(fault(header + "1,5,2,3\n").find("t.csv:3: 3 columns"), std::string::npos) << "a decimal comma";
  EXPECT_NE(fault(header + "1,2,3\n# a comment\n\n1,x,3\n").find("t.csv:6: a finite number"), std::string::npos);
  EXPECT_NE(fault("# frame: LPS\nx,y,z,x\n1,2,3,4\n").find("t.csv:2: the column x stands here twice"),
            std::string::npos);
  EXPECT_NE(fault(header).find("holds no point"), std::string::npos);
  EXPECT_NE(fault("# frame: LPS\n# units of displacement: cm\nx,y,z\n1,2,3\n").find("t.csv:2: the unit is cm"),
            std::string::npos);
  for (const char* usual :
       {"unit: mm", "Units: Millimeters", "units = [mm]", "unit: neurosurgery", "units of time: s"}) {
    EXPECT_EQ(fault(std::string("# frame: LPS\n# ") + usual + "\nx,y,z\n1,2,3\n"), "") << usual;
  }
}

TEST(PointTable, AColumnThatIsReadStandsThereOnce) {
  const ScratchFolder folder;
  const PointTable table = read_point_table(folder.write("t.csv", "# frame: LPS\nx,y,z,ux,ux\n1,2,3,4,5\n"));
  EXPECT_NE(refusal([&] { vectors_in(table, "ux", "y", "z"); }).find("t.csv:2: the column ux stands here twice"),
            std::string::npos);
}

TEST(PointTable, AColumnThatIsNotThereIsNamed) {
  const ScratchFolder folder;
  const PointTable table = read_point_table(folder.write("t.csv", header + "1,2,3\n"));
  EXPECT_NE(refusal([&] { vectors_in(table, "ux", "y", "z"); }).find("\"ux\""), std::string::npos);
  EXPECT_NE(refusal([&] { texts_in(table, "label"); }).find("\"label\""), std::string::npos);
}

TEST(PointTable, AnFcsvHasTheColumnsOf3DSlicerUnlessItNamesOthers) {
  const ScratchFolder folder;
  const std::string own = "# CoordinateSystem = LPS\n";
  const PointTable table = read_point_table(folder.write("t.fcsv", own + "n1,1,2,3,0,0,0,1,1,1,0,F-1,,\n"));
  EXPECT_EQ(vectors_in(table, "x", "y", "z"), Eigen::RowVector3d(1, 2, 3));
  EXPECT_EQ(texts_in(table, "label").front(), "F-1");
  const PointTable named = read_point_table(folder.write("n.fcsv", own + "# columns = label,x,y,z\nF-2,4,5,6\n"));
  EXPECT_EQ(vectors_in(named, "x", "y", "z"), Eigen::RowVector3d(4, 5, 6));
  EXPECT_EQ(texts_in(named, "label").front(), "F-2");
}

TEST(PointTable, WrittenAgainHasOtherPlacesAndAllElseAsItWas) {
  const ScratchFolder folder;
  const auto file =
      folder.write("t.csv", "# frame: RAS\n# of the left side\nname,x,y,z\n\"a, b\", 1,2,3\n\nc ,4,5,6\n");
  Points places(2, 3);
  places << -1.5, -2.25, 3, 4, 5, -6;
  write_point_table(folder / "moved.csv", read_point_table(file), places);
  EXPECT_EQ(bytes_of(folder / "moved.csv"),
            "# frame: RAS\n# of the left side\nname,x,y,z\n\"a, b\",1.500000,2.250000,3.000000\n\n"
            "c ,-4.000000,-5.000000,-6.000000\n");
  EXPECT_EQ(vectors_in(read_point_table(folder / "moved.csv"), "x", "y", "z"), places);
}

TEST(PointTable, KeepsTheLineEndsOfWindows) {
  const ScratchFolder folder;
  const PointTable table = read_point_table(folder.write("t.csv", "# frame: LPS\r\nx,y,z\r\n1,2,3\r\n"));
  write_point_table(folder / "moved.csv", table, Points::Zero(1, 3), {{"estimated_error", {0.5}}});
  EXPECT_EQ(bytes_of(folder / "moved.csv"),
            "# frame: LPS\r\nx,y,z,estimated_error\r\n0.000000,0.000000,0.000000,0.500000\r\n");
}

TEST(PointTable, ACsvGetsTheValuesAsItsLastColumnsAndAnFcsvAsWords) {
  const ScratchFolder folder;
  const std::vector<PointValues> values = {{"estimated_error", {0.125, 0.5}}, {"uncertainty", {1, 2}}};
  const Points places = Points::Zero(2, 3);
  const auto written = [&](const std::string& name, const std::string& text) {
    write_point_table(folder / ("moved_" + name), read_point_table(folder.write(name, text)), places, values);
    return bytes_of(folder / ("moved_" + name));
  };
  EXPECT_EQ(written("t.csv", "# frame: LPS\nx,y,z,name\n1,2,3,a\n4,5,6,b\n"),
            "# frame: LPS\nx,y,z,name,estimated_error,uncertainty\n0.000000,0.000000,0.000000,a,0.125000,1.000000\n"
            "0.000000,0.000000,0.000000,b,0.500000,2.000000\n");
  EXPECT_NE(written("u.csv", "# frame: LPS\nx,y,z,estimated_error\n1,2,3,9\n4,5,6,9\n").find(",warp_estimated_error,"),
            std::string::npos);
  const std::vector<PointValues> unknown = {{"estimated_error", {std::nan(""), 0.5}}};
  write_point_table(folder / "v.csv",
                    read_point_table(folder.write("nameless.csv", "# frame: LPS\nname,x,y,z\n,1,2,3\nb,4,5,6\n")),
                    places, unknown);
  EXPECT_EQ(bytes_of(folder / "v.csv"),
            "# frame: LPS\nname,x,y,z,estimated_error\n,0.000000,0.000000,0.000000,\n"
            "b,0.000000,0.000000,0.000000,0.500000\n");
  EXPECT_EQ(in_words(unknown, 0), "");
  // 3D Slicer's columns are its own, and a row may end before its description.
  const std::string fcsv =
      written("t.fcsv", "# CoordinateSystem = LPS\n1,1,2,3,0,0,0,1,1,1,0,F-1,\"old, words\",\n2,4,5,6\n");
  EXPECT_NE(fcsv.find(",F-1,\"old, words; estimated_error 0.125 mm; uncertainty 1 mm\",\n"), std::string::npos) << fcsv;
  EXPECT_EQ(fcsv.find("0.5 mm"), std::string::npos);
}

TEST(PointTable, ThatCannotBeWrittenIsAFaultOfOutput) {
  const ScratchFolder folder;
  const PointTable table = read_point_table(folder.write("t.csv", header + "1,2,3\n"));
  EXPECT_THROW(write_point_table(folder / "none" / "t.csv", table, Points::Zero(1, 3)), std::runtime_error);
}

}  // namespace brainshift::test::point_table_test
