// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/craniotomy_load.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::solve::markup_pairs_test {

using test::refusal;
using test::ScratchFolder;

struct Point {
  std::string label, position;
};

/// As 3D Slicer 5 writes it.
std::string mrk_json(const std::string& system, const std::vector<Point>& points) {
  std::string text = R"({"@schema": "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/)"
                     R"(Resources/Schema/markups-schema-v1.0.3.json#", "markups": [{"type": "Fiducial", )"
                     R"("coordinateSystem": )" +
                     system + R"(, "coordinateUnits": "mm", "controlPoints": [)";
  for (std::size_t n = 0; n < points.size(); ++n) {
    text += (n == 0 ? "" : ", ") + std::string(R"({"id": "1", "label": ")") + points[n].label + R"(", "position": [)" +
            points[n].position + R"(], "orientation": [1, 0, 0, 0, 1, 0, 0, 0, 1], "positionStatus": "defined"})";
  }
  return text + "]}]}\n";
}

std::string fcsv(const std::string& system, const std::string& points) {
  return "# Markups fiducial file version = 4.11\n# CoordinateSystem = " + system +
         "\n# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n" + points;
}

TEST(Markups, AreReadInTheFrameThatTheFileNames) {
  const ScratchFolder folder;
  const Eigen::RowVector3d lps(-1.5, -2, 3), same(1.5, 2, 3);
  const std::vector<Point> points = {{"F-1", "1.5, 2, 3"}};
  const std::string row = "1,1.5,2,3,0,0,0,1,1,1,0,F-1,,\n";
  for (const std::string ras : {"RAS", "0"}) {
    EXPECT_EQ(read_markup_positions(folder.write("p.mrk.json", mrk_json("\"" + ras + "\"", points))).row(0), lps);
    EXPECT_EQ(read_markup_positions(folder.write("p.fcsv", fcsv(ras, row))).row(0), lps);
  }
  for (const std::string named_lps : {"LPS", "1"}) {
    EXPECT_EQ(read_markup_positions(folder.write("p.mrk.json", mrk_json("\"" + named_lps + "\"", points))).row(0),
              same);
    EXPECT_EQ(read_markup_positions(folder.write("p.fcsv", fcsv(named_lps, row))).row(0), same);
  }
  EXPECT_EQ(read_markup_positions(folder.write("p.mrk.json", mrk_json("0", points))).row(0), lps);
  EXPECT_EQ(read_markup_positions(folder.write("p.mrk.json", mrk_json("1", points))).row(0), same);
}

TEST(Markups, OfOneLabelArePairedWhateverTheirOrderAndFormat) {
  const ScratchFolder folder;
  const auto before =
      folder.write("before.mrk.json", mrk_json("\"LPS\"", {{"vein", "1, 1, 1"}, {"sulcus", "2, 2, 2"}}));
  const auto after = folder.write(
      "after.fcsv", fcsv("RAS", "a,-2,-2,7,0,0,0,1,1,1,0,sulcus,\"deep, left\",\nb,-1,-1,4,0,0,0,1,1,1,0,vein,,\n"));
  const CraniotomyLoad load = read_markups(before, after);
  ASSERT_EQ(load.positions.rows(), 2);
  EXPECT_EQ(load.positions.row(0), Eigen::RowVector3d(1, 1, 1));
  EXPECT_EQ(load.displacement.row(0), Eigen::RowVector3d(0, 0, 3));
  EXPECT_EQ(load.displacement.row(1), Eigen::RowVector3d(0, 0, 5));
}

TEST(Markups, WithoutACommonLabelArePairedByOrder) {
  const ScratchFolder folder;
  const auto before = folder.write("b.mrk.json", mrk_json("\"LPS\"", {{"b-1", "0, 0, 0"}, {"b-2", "5, 0, 0"}}));
  const auto after = folder.write("a.mrk.json", mrk_json("\"LPS\"", {{"a-1", "1, 0, 0"}, {"a-2", "5, 2, 0"}}));
  const CraniotomyLoad load = read_markups(before, after);
  EXPECT_EQ(load.displacement.row(0), Eigen::RowVector3d(1, 0, 0));
  EXPECT_EQ(load.displacement.row(1), Eigen::RowVector3d(0, 2, 0));
}

TEST(Markups, ThatCannotBePairedAreRefused) {
  const ScratchFolder folder;
  const auto pair = [&](const std::vector<Point>& before, const std::vector<Point>& after) {
    const auto first = folder.write("b.mrk.json", mrk_json("\"LPS\"", before));
    const auto second = folder.write("a.mrk.json", mrk_json("\"LPS\"", after));
    return refusal([&] { read_markups(first, second); });
  };
  const std::string p = "0, 0, 0";
  EXPECT_NE(pair({{"x", p}, {"y", p}}, {{"x", p}}).find("\"y\""), std::string::npos);
  EXPECT_NE(pair({{"x", p}}, {{"x", p}, {"y", p}}).find("\"y\""), std::string::npos);
  EXPECT_NE(pair({{"x", p}, {"y", p}}, {{"y", p}, {"z", p}}).find("partner"), std::string::npos);
  EXPECT_NE(pair({{"x", p}, {"x", p}, {"y", p}}, {{"y", p}, {"x", p}, {"x", p}}).find("same label"), std::string::npos);
  EXPECT_NE(pair({{"x", p}, {"y", p}}, {{"v", p}}).find("holds 1 points"), std::string::npos);
}

}  // namespace brainshift::solve::markup_pairs_test
