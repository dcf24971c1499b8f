// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkXMLPolyDataWriter.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "segmentation/surface/vtk_bridge.hpp"
#include "solve/cut/cut_path.hpp"
#include "solve/cut/read_cut.hpp"
#include "tests/unit/solve/load/files.hpp"

namespace brainshift::solve {
namespace {

using testing_files::fault_of;
using testing_files::TestFolder;

void expect_parts(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    EXPECT_NE(message.find(part), std::string::npos) << "no '" << part << "' in: " << message;
  }
}

/// A square of n × n vertices, 10 mm wide, in z = 5; a triangle is left out where `leave_out` says so.
Surface square(int n, const std::function<bool(int, int)>& leave_out = {}) {
  Surface sheet{Points(n * n, 3), Triangles(0, 3)};
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      sheet.vertices.row(j * n + i) << 10.0 * i / (n - 1), 10.0 * j / (n - 1), 5;
      if (i + 1 < n && j + 1 < n && !(leave_out && leave_out(i, j))) {
        const std::int32_t corner = j * n + i;
        triangles.push_back({corner, corner + 1, corner + n + 1});
        triangles.push_back({corner, corner + n + 1, corner + n});
      }
    }
  }
  sheet.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    sheet.triangles.row(static_cast<Eigen::Index>(t)) << triangles[t][0], triangles[t][1], triangles[t][2];
  }
  return sheet;
}

Surface with_triangles(Surface sheet, const std::vector<std::array<double, 3>>& vertices,
                       const std::vector<std::array<std::int32_t, 3>>& triangles) {
  for (const auto& v : vertices) {
    sheet.vertices.conservativeResize(sheet.vertices.rows() + 1, Eigen::NoChange);
    sheet.vertices.bottomRows<1>() << v[0], v[1], v[2];
  }
  for (const auto& t : triangles) {
    sheet.triangles.conservativeResize(sheet.triangles.rows() + 1, Eigen::NoChange);
    sheet.triangles.bottomRows<1>() << t[0], t[1], t[2];
  }
  return sheet;
}

/// A band of n quadrilaterals around the z axis, turned half round for each of `half_turns`.
Surface band(int n, int half_turns) {
  Surface sheet{Points(2 * n, 3), Triangles(2 * n, 3)};
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n, turn = half_turns * angle / 2;
    const Eigen::RowVector3d out(std::cos(angle), std::sin(angle), 0);
    const Eigen::RowVector3d across = 3 * (std::sin(turn) * out + std::cos(turn) * Eigen::RowVector3d::UnitZ());
    sheet.vertices.row(2 * i) = 10 * out - across;
    sheet.vertices.row(2 * i + 1) = 10 * out + across;
    const bool crossed = i + 1 == n && half_turns % 2 != 0;
    const std::int32_t a = 2 * i, b = a + 1, c = (2 * (i + 1) + (crossed ? 1 : 0)) % (2 * n), d = c ^ 1;
    sheet.triangles.row(2 * i) << a, c, b;
    sheet.triangles.row(2 * i + 1) << b, c, d;
  }
  return sheet;
}

/// Twice the area of a flat sheet's triangles, with the sign of their orientation.
double signed_area(const Cut& cut) {
  double sum = 0;
  for (const auto& t : cut.triangles.rowwise()) {
    const Eigen::RowVector3d a = cut.vertices.row(t[1]) - cut.vertices.row(t[0]);
    const Eigen::RowVector3d b = cut.vertices.row(t[2]) - cut.vertices.row(t[0]);
    sum += a[0] * b[1] - a[1] * b[0];
  }
  return sum;
}

void write_with_times(const std::filesystem::path& file, const Surface& sheet, const std::vector<double>& times,
                      int components = 1) {
  const auto data = to_vtk(sheet);
  vtkNew<vtkDoubleArray> array;
  array->SetName("time");
  array->SetNumberOfComponents(components);
  for (const double time : times) {
    array->InsertNextValue(time);
  }
  data->GetPointData()->AddArray(array);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputData(data);
  ASSERT_EQ(writer->Write(), 1);
}

TEST(CutPath, IsReadWithAndWithoutTimes) {
  const TestFolder folder;
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
  const TestFolder folder;
  const std::pair<const char*, std::vector<std::string>> cases[] = {
      {"", {"empty"}},
      {"a,b\n0,0\n1,1\n", {"line 1", "x,y or x,y,time"}},
      {"# cut\n0,0\n1,1\n", {"line 2", "x,y or x,y,time"}},
      {"# cut\n", {"line 2", "x,y"}},
      {"x,y\n0,0\n1,1,2\n", {"line 3", "two numbers", "1,1,2"}},
      {"x,y,time\n0,0,0\n1,1\n", {"line 3", "three numbers"}},
      {"x,y\n0,0\n1,one\n", {"line 3", "finite number", "one"}},
      {"x,y\n0,0\nnan,1\n", {"line 3", "finite number", "nan"}},
      {"x,y\n", {"holds 0 vertices", "at least two"}},
      {"x,y\n1,1\n", {"holds 1 vertex;", "at least two"}},
      {"x,y\n0,0\n# again\n0,0\n", {"line 4", "repeats", "remove"}},
      {"x,y\n0,0\n10,0\n10,10\n5,-5\n", {"lines 2 to 3", "lines 4 to 5", "crosses or touches"}},
      {"x,y\n0,0\n10,0\n10,10\n5,0\n", {"lines 2 to 3", "lines 4 to 5", "crosses or touches"}},
      {"x,y\n0,0\n10,0\n10,10\n0,0\n", {"lines 2 to 3", "lines 4 to 5", "crosses or touches"}},
      {"x,y\n0,0\n10,0\n4,0\n", {"lines 2 to 3", "lines 3 to 4", "crosses or touches"}},
      {"x,y,time\n0,0,0.5\n1,1,0.25\n", {"line 3", "before"}},
      {"x,y,time\n0,0,-1\n1,1,0\n", {"line 2", "negative"}},
      {"x,y,time\n0,0,0\n1,1,inf\n", {"line 3", "finite number", "inf"}},
  };
  for (const auto& [text, parts] : cases) {
    SCOPED_TRACE(text);
    const auto file = folder.write("cut.csv", text);
    const std::string fault = fault_of([&] { read_cut(file); });
    expect_parts(fault, parts);
    expect_parts(fault, {"cut.csv"});
  }
}

TEST(CutPath, RefusesAFileThatIsNotThereOrOfAnotherKind) {
  const TestFolder folder;
  expect_parts(fault_of([&] { read_cut(folder / "none.csv"); }), {"none.csv", "no such file"});
  expect_parts(fault_of([&] { read_cut(folder / "."); }), {"no such file"});
  expect_parts(fault_of([&] { read_cut(folder.write("cut.txt", "x,y\n")); }), {"cut.txt", ".csv", ".vtp, .stl"});
}

TEST(CutPath, RefusesATimingThatCannotBe) {
  const TestFolder folder;
  const auto timed = folder.write("timed.csv", "x,y,time\n0,0,0\n1,1,1\n");
  expect_parts(fault_of([&] { read_cut(timed, {.speed = 2}); }), {"timed.csv", "holds the times", "leave"});
  expect_parts(fault_of([&] { read_cut(timed, {.start = 2}); }), {"timed.csv", "holds the times"});
  const std::vector<std::pair<double, double>> line = {{0, 0}, {1, 1}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_parts(fault_of([&] { cut_path(line, {.start = -1}, "cut 1"); }), {"cut 1", "start", "-1", "0 or later"});
  expect_parts(fault_of([&] { cut_path(line, {.start = nan}, "cut 1"); }), {"cut 1", "start", "nan"});
  expect_parts(fault_of([&] { cut_path(line, {.speed = 0}, "cut 1"); }), {"cut 1", "speed", "above 0"});
  expect_parts(fault_of([&] { cut_path(line, {.speed = nan}, "cut 1"); }), {"cut 1", "speed"});
  expect_parts(fault_of([&] {
                 cut_path(line, {.speed = 1, .direction = {0, 1, 0}}, "cut 1");
               }),
               {"cut 1", "first vertex", "leave the direction out"});
}

TEST(CutPath, FaultsOfOneThatStandsElsewhereNameThePoint) {
  expect_parts(fault_of([] { cut_path({{0, 0}, {1, 1}, {1, 1}}, {}, "the path 1"); }), {"the path 1, point 3"});
  expect_parts(fault_of([] {
                 cut_path({{0, 0}, {2, 0}, {2, 2}, {1, -1}}, {}, "the path 1");
               }),
               {"points 1 to 2", "points 3 to 4"});
  expect_parts(fault_of([] { cut_path({{0, 0}, {1, INFINITY}}, {}, "the path 1"); }), {"point 2", "not finite"});
}

TEST(CutSheet, IsReadFromVtpAndStlWithItsPointsMerged) {
  const TestFolder folder;
  const Surface sheet = square(4);
  for (const char* name : {"sheet.vtp", "sheet.stl"}) {
    write_surface(folder / name, sheet);
    const Cut cut = read_cut(folder / name);
    EXPECT_FALSE(cut.is_path());
    EXPECT_EQ(cut.vertices.rows(), 16);
    EXPECT_EQ(cut.triangles.rows(), 18);
    EXPECT_NEAR(signed_area(cut), 200, 1e-4);
    EXPECT_TRUE(cut.time.empty());
  }
}

TEST(CutSheet, TrianglesAreTurnedToAgreeWithTheFirst) {
  const TestFolder folder;
  Surface sheet = square(4);
  for (const Eigen::Index t : {1, 4, 5, 11, 17}) {
    std::swap(sheet.triangles(t, 0), sheet.triangles(t, 1));
  }
  write_surface(folder / "sheet.vtp", sheet);
  EXPECT_NEAR(signed_area(read_cut(folder / "sheet.vtp")), 200, 1e-9);
}

TEST(CutSheet, KeepsTheTimesOfThePointsThatItUses) {
  const TestFolder folder;
  Surface sheet = square(2);
  sheet.vertices.conservativeResize(5, Eigen::NoChange);
  sheet.vertices.row(4) = sheet.vertices.row(0).eval();
  sheet.vertices.row(0) << -100, 0, 0;  // no triangle's
  sheet.triangles << 4, 1, 3, 4, 3, 2;
  write_with_times(folder / "sheet.vtp", sheet, {9, 0.1, 0.2, 0.3, 0.4});
  const Cut cut = read_cut(folder / "sheet.vtp");
  ASSERT_EQ(cut.vertices.rows(), 4);
  ASSERT_EQ(cut.time.size(), 4U);
  for (Eigen::Index i = 0; i < 4; ++i) {
    const bool right = cut.vertices(i, 0) > 5, top = cut.vertices(i, 1) > 5;
    EXPECT_EQ(cut.time[static_cast<std::size_t>(i)], top ? (right ? 0.3 : 0.2) : (right ? 0.1 : 0.4));
  }
}

TEST(CutSheet, IsTimedByASpeedInADirection) {
  const TestFolder folder;
  write_surface(folder / "sheet.vtp", square(3));
  const Cut cut = read_cut(folder / "sheet.vtp", {.start = 0.5, .speed = 20, .direction = {-7, 0, 0}});
  for (Eigen::Index i = 0; i < cut.vertices.rows(); ++i) {
    EXPECT_NEAR(cut.time[static_cast<std::size_t>(i)], 0.5 + (10 - cut.vertices(i, 0)) / 20, 1e-12);
  }
}

TEST(CutSheet, RefusesATimingThatCannotBe) {
  const TestFolder folder;
  write_surface(folder / "plain.vtp", square(2));
  const auto plain = [&](const CutTiming& timing) { return fault_of([&] { read_cut(folder / "plain.vtp", timing); }); };
  expect_parts(plain({.speed = 2}), {"plain.vtp", "direction", "point array time"});
  expect_parts(plain({.direction = {0, 0, 1}}), {"plain.vtp", "direction but no speed"});
  expect_parts(plain({.speed = 1, .direction = {0, 0, NAN}}), {"plain.vtp", "direction", "finite"});
  write_with_times(folder / "timed.vtp", square(2), {0, 1, 2, 3});
  expect_parts(fault_of([&] {
                 read_cut(folder / "timed.vtp", {.speed = 1, .direction = {0, 0, 1}});
               }),
               {"timed.vtp", "holds the times"});
  write_with_times(folder / "negative.vtp", square(2), {0, 1, -2, 3});
  expect_parts(fault_of([&] { read_cut(folder / "negative.vtp"); }), {"negative.vtp", "point 3", "-2"});
  write_with_times(folder / "infinite.vtp", square(2), {0, INFINITY, 2, 3});
  expect_parts(fault_of([&] { read_cut(folder / "infinite.vtp"); }), {"infinite.vtp", "point 2", "finite"});
  write_with_times(folder / "vectors.vtp", square(2), std::vector<double>(8, 0), 2);
  expect_parts(fault_of([&] { read_cut(folder / "vectors.vtp"); }), {"vectors.vtp", "2 numbers a point"});
}

TEST(CutSheet, RefusesWhatCannotBeCutAlong) {
  const TestFolder folder;
  const auto in_middle = [](int i, int j) { return i == 2 && j == 2; };
  const auto diagonal = [](int i, int j) { return (i == 0) != (j == 0); };
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
      {"closed", tetrahedron, {"closed", "resection"}},
      {"a ring", band(12, 0), {"hole"}},
      {"a hole", square(6, in_middle), {"hole", "rim 8 mm", "(5, 5, 5)"}},
      {"crossing",
       with_triangles(square(2), {{20, 0, 5}, {5, 5, -5}, {4, 4, 15}}, {{1, 4, 3}, {4, 5, 3}, {5, 6, 3}}),
       {"crosses or touches"}},
      {"folded back", with_triangles(square(2), {{2, 5, 5}}, {{1, 3, 4}}), {"crosses or touches", "triangles"}},
  };
  for (const auto& [what, sheet, parts] : cases) {
    SCOPED_TRACE(what);
    write_surface(folder / "sheet.vtp", sheet);
    const std::string fault = fault_of([&] { read_cut(folder / "sheet.vtp"); });
    expect_parts(fault, parts);
    expect_parts(fault, {"sheet.vtp"});
  }
}

TEST(CutSheet, RefusesPartsThatHangTogetherByAVertex) {
  const TestFolder folder;
  // A ring of squares whose corner is missing too: two of them meet in the vertex between the gaps.
  write_surface(folder / "sheet.vtp", square(4, [](int i, int j) { return i == j && i > 0; }));
  expect_parts(fault_of([&] { read_cut(folder / "sheet.vtp"); }), {"sheet.vtp", "one vertex only", "6.66667, 6.66667"});
}

TEST(CutSheet, RefusesAFileThatIsNone) {
  const TestFolder folder;
  expect_parts(fault_of([&] { read_cut(folder.write("cut.stl", "this is no surface")); }), {"cut.stl"});
  expect_parts(fault_of([&] { read_cut(folder.write("cut.vtp", "this is no surface")); }), {"cut.vtp"});
}

}  // namespace
}  // namespace brainshift::solve
