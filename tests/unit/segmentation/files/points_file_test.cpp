// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/points_file.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/unit/markup_texts.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::test::points_file_test {

using Texts = std::vector<std::string>;

/// Two lists in different frames; the second's first point is not placed.
const std::string two_lists = R"({"note": 7, "markups": [
  {"coordinateSystem": "RAS", "controlPoints": [{"label": "a", "position": [1, 2, 3], "locked": true}]},
  {"controlPoints": [{"label": "b", "position": [0, 0, 0], "positionStatus": "undefined"},
                     {"label": "c", "position": [4, 5, 6], "positionStatus": "defined"}]}]})";

TEST(PointsFile, OfMarkupsHoldsThePlacedPointsOfAllItsListsInLps) {
  const ScratchFolder folder;
  const PointsFile file(folder.write("p.mrk.json", two_lists));
  Points places(2, 3);
  places << -1, -2, 3, 4, 5, 6;
  EXPECT_EQ(file.positions(), places);
  EXPECT_EQ(file.labels(), (Texts{"a", "c"}));
  EXPECT_EQ(file.not_placed(), (Texts{"control point 1 (\"b\")"}));
  EXPECT_EQ(file.lists(), 2U);
}

TEST(PointsFile, OfMarkupsMovesThePlacedPointsAndNothingElse) {
  const ScratchFolder folder;
  Points moved(2, 3);
  moved << 10, -20, 30, 40, 50, 0.1;
  PointsFile(folder.write("p.mrk.json", two_lists)).write_moved(folder / "m.mrk.json", moved);
  EXPECT_EQ(PointsFile(folder / "m.mrk.json").positions(), moved);
  auto expected = nlohmann::ordered_json::parse(two_lists);
  expected["markups"][0]["controlPoints"][0]["position"] = {-10.0, 20.0, 30.0};
  expected["markups"][1]["controlPoints"][1]["position"] = {40.0, 50.0, 0.1};
  EXPECT_EQ(nlohmann::ordered_json::parse(bytes_of(folder / "m.mrk.json")).dump(), expected.dump());
}

TEST(PointsFile, OfMarkupsGetsTheValuesAsWordsOfItsDescriptions) {
  const ScratchFolder folder;
  const std::string text = R"({"markups": [{"controlPoints": [{"label": "a", "position": [1, 2, 3]},
    {"label": "b", "position": [4, 5, 6], "description": "old"}]}]})";
  const PointsFile file(folder.write("p.mrk.json", text));
  file.write_moved(folder / "m.mrk.json", file.positions(),
                   {{"estimated_error", {0.1234, 2}}, {"uncertainty", {1, 3}}});
  auto expected = nlohmann::ordered_json::parse(text);
  auto& points = expected["markups"][0]["controlPoints"];
  points[0]["position"] = {1.0, 2.0, 3.0};
  points[1]["position"] = {4.0, 5.0, 6.0};
  points[0]["description"] = "estimated_error 0.123 mm; uncertainty 1 mm";
  points[1]["description"] = "old; estimated_error 2 mm; uncertainty 3 mm";
  EXPECT_EQ(nlohmann::ordered_json::parse(bytes_of(folder / "m.mrk.json")).dump(), expected.dump());
}

TEST(PointsFile, OfATableIsOneListWithALabelAPoint) {
  const ScratchFolder folder;
  const PointsFile table(folder.write("p.csv", "# frame: RAS\nx,y,z,label\n1,2,3,a\n4,5,6,\n"));
  EXPECT_EQ(table.positions().row(1), Eigen::RowVector3d(-4, -5, 6));
  EXPECT_EQ(table.labels(), (Texts{"a", ""}));
  EXPECT_EQ(table.lists(), 1U);
  EXPECT_EQ(PointsFile(folder.write("q.csv", "# frame: LPS\nx,y,z\n1,2,3\n")).labels(), Texts{""});
}

TEST(PointsFile, OfATableIsWrittenWithItsPointsMoved) {
  const ScratchFolder folder;
  Points moved(1, 3);
  moved << 7, -8, 9.5;
  const PointsFile file(folder.write("p.fcsv", fcsv("RAS", "1,1,2,3,0,0,0,1,1,1,0,F-1,,\n")));
  file.write_moved(folder / "m.fcsv", moved);
  EXPECT_EQ(PointsFile(folder / "m.fcsv").positions(), moved);
  EXPECT_EQ(PointsFile(folder / "m.fcsv").labels(), Texts{"F-1"});
}

TEST(PointsFile, ThatCannotBeWrittenIsAFaultOfOutput) {
  const ScratchFolder folder;
  const PointsFile file(folder.write("p.mrk.json", two_lists));
  EXPECT_THROW(file.write_moved(folder / "none" / "m.mrk.json", file.positions()), std::runtime_error);
}

TEST(PointsFile, IsKnownByItsEnding) {
  for (const char* const name : {"a.mrk.json", "a.fcsv", "a.b.csv"}) {
    EXPECT_TRUE(is_points_file(name)) << name;
  }
  for (const char* const name : {"a.json", "a.nii", "csv", "a.csv.gz"}) {
    EXPECT_FALSE(is_points_file(name)) << name;
  }
}

TEST(PointsFile, OfMalformedJsonIsRefused) {
  const ScratchFolder folder;
  const auto fault = [&](const std::string& text) {
    const auto file = folder.write("bad.mrk.json", text);
    const std::string what = refusal([&] { PointsFile(file).positions(); });
    EXPECT_NE(what.find("bad.mrk.json"), std::string::npos) << what;
    return what;
  };
  const std::string good = mrk_json("\"LPS\"", {{"a", "1, 2, 3"}});
  fault("");
  fault("[]");
  fault("{}");
  fault("{\"markups\": []}");
  fault("{\"markups\": [1]}");
  fault(good.substr(0, good.size() / 2));
  fault(good + "x");
  fault(mrk_json("\"LPS\"", {}));
  EXPECT_NE(fault(mrk_json("\"IJK\"", {{"a", "1, 2, 3"}})).find("IJK"), std::string::npos);
  EXPECT_NE(fault(mrk_json("null", {{"a", "1, 2, 3"}})).find("null"), std::string::npos);
  EXPECT_NE(fault(mrk_json("\"LPS\"", {{"a", "1, 2, 3"}, {"b", "1, 2"}})).find("point 2 (\"b\")"), std::string::npos);
  EXPECT_NE(fault(mrk_json("\"LPS\"", {{"a", "1, \"2\", 3"}})).find("point 1"), std::string::npos);
  EXPECT_NE(fault(mrk_json("\"LPS\"", {{"a", "1, null, 3"}})).find("point 1"), std::string::npos);
  fault(mrk_json("\"LPS\"", {{"a", "1, 1e999, 3"}}));
  std::string unplaced = good;
  unplaced.replace(unplaced.find("\"defined\""), 9, "\"undefined\"");
  EXPECT_NE(fault(unplaced).find("placed"), std::string::npos);
  std::string inches = good;
  inches.replace(inches.find("\"mm\""), 4, "\"in\"");
  EXPECT_NE(fault(inches).find("\"in\""), std::string::npos);
}

TEST(PointsFile, OfMalformedFcsvIsRefusedWithTheLine) {
  const ScratchFolder folder;
  const auto fault = [&](const std::string& text) {
    const auto file = folder.write("bad.fcsv", text);
    return refusal([&] { PointsFile(file).positions(); });
  };
  const std::string good = "1,1,2,3,0,0,0,1,1,1,0,F-1,,\n";
  EXPECT_NE(fault("# Markups fiducial file version = 4.6\n" + good).find("CoordinateSystem"), std::string::npos);
  EXPECT_NE(fault(fcsv("2", good)).find(":2:"), std::string::npos);
  EXPECT_NE(fault(fcsv("LPS", good + "1,1,x,3,0,0,0,1,1,1,0,F-1,,\n")).find(":5:"), std::string::npos);
  EXPECT_NE(fault(fcsv("LPS", good + "1,1,2,3\n")).find(":5:"), std::string::npos);
  EXPECT_NE(fault(fcsv("LPS", "")).find("no point"), std::string::npos);
  EXPECT_NE(fault("# CoordinateSystem = LPS\n# columns = id,x,y,label\n1,2,3,a\n").find("x, y and z is expected"),
            std::string::npos);
}

TEST(PointsFile, OfAnUnknownKindIsRefused) {
  const ScratchFolder folder;
  EXPECT_NE(refusal([&] { PointsFile(folder.write("p.txt", "1,2,3")).positions(); }).find(".fcsv"), std::string::npos);
}

TEST(PointsFile, PlanesAndBoxesSayTheirPlaceTwiceAndBothMove) {
  const test::ScratchFolder folder;
  const PointsFile box(folder.write("roi.mrk.json", R"({"markups": [{"type": "ROI", "coordinateSystem": "RAS",
    "center": [1, 2, 3], "size": [4, 5, 6], "baseToNode": [1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1],
    "controlPoints": [{"position": [1, 2, 3]}]}]})"));
  box.write_moved(folder / "moved.mrk.json", box.positions().rowwise() + Eigen::RowVector3d(10, 20, 30));
  const auto moved = nlohmann::json::parse(test::bytes_of(folder / "moved.mrk.json"))["markups"][0];
  EXPECT_EQ(moved["center"], nlohmann::json({-9.0, -18.0, 33.0}));
  EXPECT_EQ(moved["controlPoints"][0]["position"], moved["center"]);
  EXPECT_EQ(moved["baseToNode"][3], -9.0);
  EXPECT_EQ(moved["baseToNode"][7], -18.0);
  EXPECT_EQ(moved["baseToNode"][11], 33.0);
  EXPECT_EQ(moved["size"], nlohmann::json({4, 5, 6}));
}

}  // namespace brainshift::test::points_file_test
