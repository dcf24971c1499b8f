// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/craniotomy_load.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/unit/markup_texts.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::solve::markup_pairs_test {

using test::fcsv;
using test::MarkupPoint;
using test::mrk_json;
using test::refusal;
using test::ScratchFolder;

TEST(Markups, AreReadInTheFrameThatTheFileNames) {
  const ScratchFolder folder;
  const Eigen::RowVector3d lps(-1.5, -2, 3), same(1.5, 2, 3);
  const std::vector<MarkupPoint> points = {{"F-1", "1.5, 2, 3"}};
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
  EXPECT_FALSE(load.paired_by_order);
}

/// Two lists in LPS.
CraniotomyLoad paired(const std::vector<MarkupPoint>& before, const std::vector<MarkupPoint>& after) {
  const ScratchFolder folder;
  return read_markups(folder.write("b.mrk.json", mrk_json("\"LPS\"", before)),
                      folder.write("a.mrk.json", mrk_json("\"LPS\"", after)));
}

/// The first point moves along x, the second along y.
void expect_moved_apart(const CraniotomyLoad& load, bool by_order) {
  EXPECT_EQ(load.displacement.row(0), Eigen::RowVector3d(1, 0, 0));
  EXPECT_EQ(load.displacement.row(1), Eigen::RowVector3d(0, 2, 0));
  EXPECT_EQ(load.paired_by_order, by_order);
}

TEST(Markups, ArePairedByLabelWhateverItsCaseAndTheBlanksAboutIt) {
  const std::vector<MarkupPoint> before = {{"Vein ", "0, 0, 0"}, {"sulcus", "5, 0, 0"}};
  expect_moved_apart(paired(before, {{"Sulcus", "5, 2, 0"}, {"vein", "1, 0, 0"}}), false);
  expect_moved_apart(paired({{"a", "0, 0, 0"}, {"A", "5, 0, 0"}}, {{"A", "5, 2, 0"}, {"a", "1, 0, 0"}}), false);
  EXPECT_NE(refusal([&] {
              paired(before, {{"VEIN", "5, 2, 0"}, {"gyrus", "1, 0, 0"}});
            }).find("\"gyrus\" of"),
            std::string::npos);
}

TEST(Markups, WithoutACommonLabelArePairedByOrder) {
  expect_moved_apart(paired({{"b-1", "0, 0, 0"}, {"b-2", "5, 0, 0"}}, {{"a-1", "1, 0, 0"}, {"a-2", "5, 2, 0"}}), true);
}

TEST(Markups, ThatCannotBePairedAreRefused) {
  const auto pair = [&](const std::vector<MarkupPoint>& before, const std::vector<MarkupPoint>& after) {
    return refusal([&] { paired(before, after); });
  };
  const std::string p = "0, 0, 0";
  EXPECT_NE(pair({{"x", p}, {"y", p}}, {{"x", p}}).find("\"y\""), std::string::npos);
  EXPECT_NE(pair({{"x", p}}, {{"x", p}, {"y", p}}).find("\"y\""), std::string::npos);
  EXPECT_NE(pair({{"x", p}, {"y", p}}, {{"y", p}, {"z", p}}).find("partner"), std::string::npos);
  EXPECT_NE(pair({{"x", p}, {"x", p}, {"y", p}}, {{"y", p}, {"x", p}, {"x", p}}).find("same label"), std::string::npos);
  EXPECT_NE(pair({{"x", p}, {"y", p}}, {{"v", p}}).find("holds 1 points"), std::string::npos);
}

}  // namespace brainshift::solve::markup_pairs_test
