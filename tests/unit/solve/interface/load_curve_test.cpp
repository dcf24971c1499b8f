// SPDX-License-Identifier: GPL-3.0-or-later

#include "solve/interface/load_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::solve::load_curve_test {

using Join = LoadCurve::Join;

TEST(LoadCurve, StartsAndEndsAtRest) {
  EXPECT_EQ(smooth_load(0), 0);
  EXPECT_EQ(smooth_load(1), 1);
  EXPECT_EQ(smooth_load(2), 1);
  EXPECT_DOUBLE_EQ(smooth_load(0.5), 0.5);
  for (const double end : {0.0, 1.0}) {
    const double inside = end == 0 ? 1e-3 : 1 - 1e-3;
    EXPECT_LE(std::abs(smooth_load(inside) - end), 1.1e-8);  // velocity and acceleration vanish
  }
}

TEST(LoadCurve, IsOneSmoothRiseByDefault) {
  const LoadCurve curve;
  EXPECT_EQ(curve.duration(), 1);
  for (const double t : {0.0, 0.2, 0.5, 0.9, 1.0}) {
    EXPECT_DOUBLE_EQ(curve.at(t), smooth_load(t));
  }
}

TEST(LoadCurve, GoesThroughItsRowsHoweverTheyAreJoined) {
  const std::vector<double> time = {0, 2, 3, 7}, factor = {0, 1.5, -0.5, 0.25};
  for (const Join join : {Join::smooth, Join::straight}) {
    const LoadCurve curve(time, factor, join);
    EXPECT_EQ(curve.duration(), 7);
    for (std::size_t i = 0; i < time.size(); ++i) {
      EXPECT_DOUBLE_EQ(curve.at(time[i]), factor[i]);
    }
    EXPECT_DOUBLE_EQ(curve.at(2.5), 0.5);  // half-way both joins agree
  }
}

TEST(LoadCurve, IsStraightOrAtRestAtTheRowsBetweenThem) {
  const LoadCurve straight({0, 2, 3}, {0, 1.5, -0.5}, Join::straight), smooth({0, 2, 3}, {0, 1.5, -0.5}, Join::smooth);
  EXPECT_DOUBLE_EQ(straight.at(0.5), 0.375);
  EXPECT_DOUBLE_EQ(straight.at(2.25), 1.0);
  EXPECT_DOUBLE_EQ(smooth.at(0.5), 1.5 * smooth_load(0.25));
  for (const double side : {-1e-4, 1e-4}) {
    EXPECT_NEAR(smooth.at(2 + side), 1.5, 1e-10);
    EXPECT_GT(std::abs(straight.at(2 + side) - 1.5), 1e-5);
  }
}

TEST(LoadCurve, StaysWhatItIsOutsideItsRows) {
  for (const Join join : {Join::smooth, Join::straight}) {
    const LoadCurve curve({0, 1, 2}, {0, 1, 0.4}, join);
    EXPECT_EQ(curve.at(-3), 0);
    EXPECT_EQ(curve.at(2), 0.4);
    EXPECT_EQ(curve.at(1e9), 0.4);
  }
}

std::string refusal(const std::vector<double>& time, const std::vector<double>& factor) {
  return test::refusal([&] { LoadCurve(time, factor, Join::straight); });
}

TEST(LoadCurve, RefusesATableWithTheRow) {
  EXPECT_NE(refusal({0}, {0}).find("at least two rows"), std::string::npos);
  EXPECT_NE(refusal({0, 1}, {0}).find("at least two rows"), std::string::npos);
  EXPECT_NE(refusal({0, 1, 1}, {0, 1, 2}).find("row 3"), std::string::npos) << refusal({0, 1, 1}, {0, 1, 2});
  EXPECT_NE(refusal({0, 2, 1}, {0, 1, 2}).find("row 3"), std::string::npos);
  EXPECT_NE(refusal({0, std::nan("")}, {0, 1}).find("row 2"), std::string::npos);
  EXPECT_NE(refusal({0, 1}, {0, std::numeric_limits<double>::infinity()}).find("row 2"), std::string::npos);
  EXPECT_NE(refusal({0, 1, 2}, {0, -1e308, 1}).find("row 2"), std::string::npos);
  EXPECT_NE(refusal({0, 1e308}, {0, 1}).find("time must be at most"), std::string::npos);
  EXPECT_NE(refusal({0, 1}, {0.5, 1}).find("start at time 0 with factor 0"), std::string::npos);
  EXPECT_NE(refusal({-1, 1}, {0, 1}).find("start at time 0 with factor 0"), std::string::npos);
}

/// A file of its own for each test.
class LoadCurveFile : public testing::Test {
 protected:
  test::ScratchFolder folder;
  std::filesystem::path file = folder / "curve.csv";

  LoadCurve read(const std::string& text) {
    std::ofstream(file) << text;
    return read_load_curve(file, Join::straight);
  }
  std::string refusal_of(const std::string& text) {
    return test::refusal([&] { read(text); });
  }
};

TEST_F(LoadCurveFile, IsReadWithItsCommentsAside) {
  const LoadCurve curve = read("# measured\n# twice\ntime,factor\n0,0\n# a pause\n 0.5 , 1\n2,-1e-1\n");
  EXPECT_EQ(curve.duration(), 2);
  EXPECT_DOUBLE_EQ(curve.at(0.25), 0.5);
  EXPECT_DOUBLE_EQ(curve.at(2), -0.1);
}

TEST_F(LoadCurveFile, IsRefusedWithFileAndLine) {
  const std::pair<std::string, std::string> cases[] = {
      {"t,f\n0,0\n1,1\n", ":1:"},           {"# a\ntime,factor\n0,0\n1\n", ":4:"},
      {"time,factor\n0,0\n1,one\n", ":3:"}, {"time,factor\n0,0\n# b\n2,1\n1,2\n", ":5:"},
      {"time,factor\n0,0.1\n1,1\n", ":2:"}, {"time,factor\n0,0\n1,inf\n", ":3:"},
  };
  for (const auto& [text, line] : cases) {
    const std::string message = refusal_of(text);
    EXPECT_NE(message.find(file.string()), std::string::npos) << message;
    EXPECT_NE(message.find(line), std::string::npos) << text << " gave: " << message;
  }
  EXPECT_NE(refusal_of("time,factor\n0,0\n").find(file.string()), std::string::npos);
  EXPECT_NE(test::refusal([] { read_load_curve("no_such_curve.csv", Join::smooth); }).find("no_such_curve.csv"),
            std::string::npos);
}

}  // namespace brainshift::solve::load_curve_test
