// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/cut_path.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "solve/cut/read_cut.hpp"
#include "tests/unit/expect_parts.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::solve::cut_path_test {

using test::expect_parts;
using test::refusal;
using test::ScratchFolder;

TEST(CutPath, IsReadWithAndWithoutTimes) {
  const ScratchFolder folder;
  const Cut cut = read_cut(folder.write("cut.csv", "# a cut\r\nx, y\r\n0,50\r\n# bend\r\n30,50\r\n50,+62.5\r\n\r\n"));
  EXPECT_EQ(cut.name, (folder / "cut.csv").string());
  EXPECT_TRUE(cut.is_path());
  EXPECT_EQ(cut.vertices, (Points(3, 3) << 0, 50, 0, 30, 50, 0, 50, 62.5, 0).finished());
  EXPECT_TRUE(cut.time.empty()) << "cut from the start";
  const Cut timed = read_cut(folder.write("CUT.CSV", "x,y,time\n0,50,0.25\n30,50,0.25\n50,62,1\n"));
  EXPECT_EQ(timed.time, (std::vector<double>{0.25, 0.25, 1}));
}

TEST(CutPath, IsTimedByStartAndSpeedAlongIt) {
  const std::vector<std::pair<double, double>> corner = {{0, 0}, {3, 4}, {3, 14}};
  EXPECT_EQ(cut_path(corner, {.start = 0.5, .speed = 10}, "cut").time, (std::vector<double>{0.5, 1, 2}));
  EXPECT_EQ(cut_path(corner, {.speed = 5}, "cut").time, (std::vector<double>{0, 1, 3}));
  EXPECT_EQ(cut_path(corner, {.start = 0.5}, "cut").time, (std::vector<double>{0.5, 0.5, 0.5}));
  EXPECT_TRUE(cut_path(corner, {.start = 0}, "cut").time.empty());
}

TEST(CutPath, MayBendAndRunCloseToItself) {
  EXPECT_EQ(cut_path({{0, 0}, {10, 0}, {10, 1e-9}, {0, 1e-9}}, {}, "cut").vertices.rows(), 4);
  EXPECT_EQ(cut_path({{0, 0}, {5, 0}, {10, 0}}, {}, "cut").vertices.rows(), 3) << "straight on";
}

TEST(CutPath, RefusesAFileThatIsNone) {
  const ScratchFolder folder;
  const std::pair<const char*, std::vector<std::string>> cases[] = {
      {"", {"empty"}},
      {"a,b\n0,0\n1,1\n", {":1:", "x,y or x,y,time"}},
      {"# cut\n0,0\n1,1\n", {":2:", "x,y or x,y,time"}},
      {"# cut\n", {":2:", "x,y"}},
      {"x,y\n0,0\n1,1,2\n", {":3:", "2 numbers", "1,1,2"}},
      {"x,y,time\n0,0,0\n1,1\n", {":3:", "3 numbers"}},
      {"x,y\n0,0\n1,one\n", {":3:", "finite number", "one"}},
      {"x,y\n0,0\nnan,1\n", {":3:", "finite number", "nan"}},
      {"x,y\n", {"holds 0 vertices", "at least two"}},
      {"x,y\n1,1\n", {"holds 1 vertex;", "at least two"}},
      {"x,y\n0,0\n# again\n0,0\n", {":4:", "repeats", "remove"}},
      {"x,y\n0,0\n10,0\n10,10\n5,-5\n", {"lines 2 to 3", "lines 4 to 5", "crosses or touches"}},
      {"x,y\n0,0\n10,0\n10,10\n5,0\n", {"lines 2 to 3", "lines 4 to 5", "crosses or touches"}},
      {"x,y\n0,0\n10,0\n10,10\n0,0\n", {"lines 2 to 3", "lines 4 to 5", "crosses or touches"}},
      {"x,y\n0,0\n10,0\n4,0\n", {"lines 2 to 3", "lines 3 to 4", "crosses or touches"}},
      {"x,y,time\n0,0,0.5\n1,1,0.25\n", {":3:", "before"}},
      {"x,y,time\n0,0,-1\n1,1,0\n", {":2:", "negative"}},
      {"x,y,time\n0,0,0\n1,1,inf\n", {":3:", "finite number", "inf"}},
  };
  for (const auto& [text, parts] : cases) {
    SCOPED_TRACE(text);
    const auto file = folder.write("cut.csv", text);
    const std::string fault = refusal([&] { read_cut(file); });
    expect_parts(fault, parts);
    expect_parts(fault, {"cut.csv"});
  }
}

TEST(CutPath, RefusesATimingThatCannotBe) {
  const ScratchFolder folder;
  const auto timed = folder.write("timed.csv", "x,y,time\n0,0,0\n1,1,1\n");
  expect_parts(refusal([&] { read_cut(timed, {.speed = 2}); }), {"timed.csv", "holds the times", "leave"});
  expect_parts(refusal([&] { read_cut(timed, {.start = 2}); }), {"timed.csv", "holds the times"});
  const std::vector<std::pair<double, double>> line = {{0, 0}, {1, 1}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_parts(refusal([&] { cut_path(line, {.start = -1}, "cut 1"); }), {"cut 1", "start", "-1", ">= 0"});
  expect_parts(refusal([&] { cut_path(line, {.start = nan}, "cut 1"); }), {"cut 1", "start", "nan"});
  expect_parts(refusal([&] { cut_path(line, {.speed = 0}, "cut 1"); }), {"cut 1", "speed", "> 0"});
  expect_parts(refusal([&] { cut_path(line, {.speed = nan}, "cut 1"); }), {"cut 1", "speed"});
  expect_parts(refusal([&] {
                 cut_path(line, {.speed = 1, .direction = {0, 1, 0}}, "cut 1");
               }),
               {"cut 1", "first vertex", "leave the direction out"});
}

TEST(CutPath, FaultsOfOneThatStandsElsewhereNameThePoint) {
  expect_parts(refusal([] { cut_path({{0, 0}, {1, 1}, {1, 1}}, {}, "the path 1"); }), {"the path 1, point 3"});
  expect_parts(refusal([] {
                 cut_path({{0, 0}, {2, 0}, {2, 2}, {1, -1}}, {}, "the path 1");
               }),
               {"points 1 to 2", "points 3 to 4"});
  expect_parts(refusal([] { cut_path({{0, 0}, {1, INFINITY}}, {}, "the path 1"); }), {"point 2", "not finite"});
}

}  // namespace brainshift::solve::cut_path_test
