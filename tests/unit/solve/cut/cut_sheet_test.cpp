// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/cut_sheet.hpp"

#include <gtest/gtest.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <cmath>
#include <vector>

#include "segmentation/files/surface_file.hpp"
#include "segmentation/files/vtk_bridge.hpp"
#include "solve/cut/read_cut.hpp"
#include "tests/unit/expect_parts.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/sheets.hpp"

namespace brainshift::solve::cut_sheet_test {

using test::expect_parts;
using test::refusal;
using test::ScratchFolder;
using test::square;

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

TEST(CutSheet, IsRefusedByFileWhereItCannotBeCutAlong) {
  const ScratchFolder folder;
  write_surface(folder / "ring.vtp", test::band(12, 0));
  expect_parts(refusal([&] { read_cut(folder / "ring.vtp"); }), {"ring.vtp", "hole"});
  write_surface(folder / "folded.vtp", test::folded_back());
  expect_parts(refusal([&] { read_cut(folder / "folded.vtp"); }), {"folded.vtp", "crosses or touches", "triangles"});
}

TEST(CutSheet, RefusesAFileThatIsNone) {
  const ScratchFolder folder;
  expect_parts(refusal([&] { read_cut(folder.write("cut.stl", "this is no surface")); }), {"cut.stl"});
  expect_parts(refusal([&] { read_cut(folder.write("cut.vtp", "this is no surface")); }), {"cut.vtp"});
}

}  // namespace brainshift::solve::cut_sheet_test
