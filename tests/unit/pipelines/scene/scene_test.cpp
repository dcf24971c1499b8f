// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/scene.hpp"

#include <gtest/gtest.h>

#include "segmentation/files/surface_file.hpp"
#include "tests/unit/expect_parts.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::pipelines::scene_test {

using brainshift::test::expect_parts;
using brainshift::test::refusal;
using brainshift::test::ScratchFolder;

TEST(Stages, AreKnownByTheirNames) {
  std::string names;
  for (const StageId stage : all_stages) {
    names += std::string(stage_name(stage)) + " ";
    EXPECT_TRUE(is_stage(stage_name(stage)));
    EXPECT_EQ(stage_from_name(stage_name(stage)), stage);
  }
  EXPECT_EQ(names, "segment discretise solve register report ");
  EXPECT_FALSE(is_stage("registration"));
  EXPECT_FALSE(is_stage(""));
  EXPECT_EQ(refusal([] { stage_from_name("registration"); }),
            "there is no stage 'registration'; the stages are segment, discretise, solve, register, report");
}

Loading by_file(const std::filesystem::path& file, solve::LoadCurve::Join join = solve::LoadCurve::Join::smooth) {
  Loading loading;
  loading.curve = file;
  loading.curve_join = join;
  return loading;
}

TEST(Loading, IsTheCurveOfItsFileOrOneSmoothRise) {
  const ScratchFolder folder;
  const solve::LoadCurve rise = load_curve({});
  EXPECT_EQ(rise.duration(), 1);
  EXPECT_DOUBLE_EQ(rise.at(0.25), solve::smooth_load(0.25));
  EXPECT_DOUBLE_EQ(load_curve({.duration = 4, .curve = {}}).at(1), solve::smooth_load(0.25));
  const auto file = folder.write("curve.csv", "time,factor\n0,0\n2,1\n");
  EXPECT_DOUBLE_EQ(load_curve(by_file(file, solve::LoadCurve::Join::straight)).at(0.5), 0.25);
  EXPECT_DOUBLE_EQ(load_curve(by_file(file)).at(0.5), solve::smooth_load(0.25));
  const auto bad = folder.write("bad.csv", "time,factor\n0,0\n2,x\n");
  expect_parts(refusal([&] { load_curve(by_file(bad)); }), {"bad.csv:3"});
}

TEST(CutFiles, ArePathsInAPlaneAndSheetsInSpace) {
  const ScratchFolder folder;
  const CutFile path{folder.write("path.csv", "x,y\n0,5\n10,5\n"), {.start = 0.5}};
  Surface triangle{Points(3, 3), Triangles(1, 3)};
  triangle.vertices << 0, 0, 0, 9, 0, 0, 9, 9, 0;
  triangle.triangles << 0, 1, 2;
  write_surface(folder / "sheet.vtp", triangle);
  const CutFile sheet{folder / "sheet.vtp", {}};
  EXPECT_EQ(read_cut(path, solve::Plane::strain).time, (std::vector<double>{0.5, 0.5}));
  EXPECT_EQ(read_cut(sheet, solve::Plane::none).triangles, triangle.triangles);
  expect_parts(refusal([&] { read_cut(path, solve::Plane::none); }), {"path.csv: this is a path", "along sheets"});
  expect_parts(refusal([&] { read_cut(sheet, solve::Plane::stress); }), {"sheet.vtp: this is a sheet", "along paths"});
}

TEST(Place, IsTheLineTheCommandLineOrTheFile) {
  const SceneSource source{"a/scene.xml", {{"segment.edge_length", 12}, {"load", 0}}};
  EXPECT_EQ(place(source, "segment.edge_length"), "a/scene.xml:12");
  EXPECT_EQ(place(source, "load"), "--set");
  EXPECT_EQ(place(source, "load.craniotomy"), "a/scene.xml");
}

}  // namespace brainshift::pipelines::scene_test
