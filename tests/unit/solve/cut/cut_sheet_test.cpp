// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/cut_sheet.hpp"

#include <gtest/gtest.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "segmentation/files/surface_file.hpp"
#include "segmentation/files/vtk_bridge.hpp"
#include "solve/cut/read_cut.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::solve::cut_sheet_test {

using test::refusal;
using test::ScratchFolder;

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

TEST(CutSheet, IsReadFromVtpAndStlWithItsPointsMerged) {
  const ScratchFolder folder;
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
  const ScratchFolder folder;
  Surface sheet = square(4);
  for (const Eigen::Index t : {1, 4, 5, 11, 17}) {
    std::swap(sheet.triangles(t, 0), sheet.triangles(t, 1));
  }
  write_surface(folder / "sheet.vtp", sheet);
  EXPECT_NEAR(signed_area(read_cut(folder / "sheet.vtp")), 200, 1e-9);
}

TEST(CutSheet, KeepsTheTimesOfThePointsThatItUses) {
  const ScratchFolder folder;
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
  const ScratchFolder folder;
  write_surface(folder / "sheet.vtp", square(3));
  const Cut cut = read_cut(folder / "sheet.vtp", {.start = 0.5, .speed = 20, .direction = {-7, 0, 0}});
  for (Eigen::Index i = 0; i < cut.vertices.rows(); ++i) {
    EXPECT_NEAR(cut.time[static_cast<std::size_t>(i)], 0.5 + (10 - cut.vertices(i, 0)) / 20, 1e-12);
  }
}

TEST(CutSheet, RefusesATimingThatCannotBe) {
  const ScratchFolder folder;
  write_surface(folder / "plain.vtp", square(2));
  const auto plain = [&](const CutTiming& timing) { return refusal([&] { read_cut(folder / "plain.vtp", timing); }); };
  expect_parts(plain({.speed = 2}), {"plain.vtp", "direction", "point array time"});
  expect_parts(plain({.direction = {0, 0, 1}}), {"plain.vtp", "direction but no speed"});
  expect_parts(plain({.speed = 1, .direction = {0, 0, NAN}}), {"plain.vtp", "direction", "'0 0 nan'", "three numbers"});
  write_with_times(folder / "timed.vtp", square(2), {0, 1, 2, 3});
  expect_parts(refusal([&] {
                 read_cut(folder / "timed.vtp", {.speed = 1, .direction = {0, 0, 1}});
               }),
               {"timed.vtp", "holds the times"});
  write_with_times(folder / "negative.vtp", square(2), {0, 1, -2, 3});
  expect_parts(refusal([&] { read_cut(folder / "negative.vtp"); }), {"negative.vtp", "point 3", "-2"});
  write_with_times(folder / "infinite.vtp", square(2), {0, INFINITY, 2, 3});
  expect_parts(refusal([&] { read_cut(folder / "infinite.vtp"); }), {"infinite.vtp", "point 2", "finite"});
  write_with_times(folder / "vectors.vtp", square(2), std::vector<double>(8, 0), 2);
  expect_parts(refusal([&] { read_cut(folder / "vectors.vtp"); }), {"vectors.vtp", "2 numbers a point"});
}

TEST(CutSheet, RefusesWhatCannotBeCutAlong) {
  const ScratchFolder folder;
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
    const std::string fault = refusal([&] { read_cut(folder / "sheet.vtp"); });
    expect_parts(fault, parts);
    expect_parts(fault, {"sheet.vtp"});
  }
}

TEST(CutSheet, RefusesPartsThatHangTogetherByAVertex) {
  const ScratchFolder folder;
  // A ring of squares whose corner is missing too: two of them meet in the vertex between the gaps.
  write_surface(folder / "sheet.vtp", square(4, [](int i, int j) { return i == j && i > 0; }));
  expect_parts(refusal([&] { read_cut(folder / "sheet.vtp"); }), {"sheet.vtp", "one vertex only", "6.66667, 6.66667"});
}

TEST(CutSheet, RefusesAFileThatIsNone) {
  const ScratchFolder folder;
  expect_parts(refusal([&] { read_cut(folder.write("cut.stl", "this is no surface")); }), {"cut.stl"});
  expect_parts(refusal([&] { read_cut(folder.write("cut.vtp", "this is no surface")); }), {"cut.vtp"});
}

}  // namespace brainshift::solve::cut_sheet_test
