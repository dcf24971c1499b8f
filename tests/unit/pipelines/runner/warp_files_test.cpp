// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/warp_files.hpp"

#include "pipelines/checksum/sha256.hpp"
#include "pipelines/runner/stage_record.hpp"
#include "segmentation/files/points_file.hpp"
#include "tests/unit/expect_parts.hpp"
#include "tests/unit/pipelines/run_folder.hpp"
#include "tests/unit/register/builders.hpp"

namespace brainshift::pipelines::warp_files_test {

using registration::Towards;
using test::expect_parts;
using test::refusal;
namespace builders = registration::builders;

/// A run whose brain sinks.
class WarpFiles : public RunFolder {
 protected:
  static void SetUpTestSuite() {
    run_ = std::make_unique<test::ScratchFolder>();
    fs::create_directories(*run_ / "register");
    const auto result = registration::register_images(builders::head(builders::sinking), {});
    registration::write_registration(*run_ / "register", result);
  }
  static void TearDownTestSuite() { run_.reset(); }
  void SetUp() override {
    fs::create_directories(folder_ / "out");
    fs::create_directories(folder_ / "back");
  }
  std::vector<std::string> warp(const std::vector<fs::path>& files, Towards towards, const std::string& out,
                                const fs::path& like = {}) const {
    return warp_files({.run = run_->path(), .files = files, .like = like, .towards = towards, .options = {.grid = {}}},
                      folder_ / out);
  }

  static inline std::unique_ptr<test::ScratchFolder> run_;
};

TEST_F(WarpFiles, PointsGoThereByTheKnownMotionAndComeBack) {
  const Points preop = (Points(4, 3) << 3, -5, 8, 8, -2, 25, 5, 0, 31, -8, 3, 12).finished();
  std::ostringstream text;
  text << "# frame: LPS\nx,y,z\n" << preop.format(Eigen::IOFormat(9, 0, ",", "\n")) << '\n';
  const fs::path file = write("points.csv", text.str());
  const auto notes = warp({file}, Towards::intraop, "out");
  expect_parts(notes.front(), {"points.csv: 4 points, moved by up to", "mm"});
  const Points there = PointsFile(folder_ / "out/warped_points.csv").positions();
  for (Eigen::Index p = 0; p < 4; ++p) {
    const Eigen::Vector3d known = builders::sinking(preop.row(p));
    EXPECT_LT((there.row(p) - preop.row(p) - known.transpose()).norm(), 0.05 * known.norm()) << p;
  }
  warp({folder_ / "out/warped_points.csv"}, Towards::preop, "back");
  const Points back = PointsFile(folder_ / "back/warped_warped_points.csv").positions();
  EXPECT_LT((back - preop).rowwise().norm().maxCoeff(), 0.05);
}

TEST_F(WarpFiles, ImagesAreWhatTheStageMakesOrOnAnothersGrid) {
  const auto head = builders::head(builders::sinking);
  write_image(folder_ / "t1.nii.gz", head.t1);
  write_image(folder_ / "labels.nii.gz", *head.labels);
  const auto notes = warp({folder_ / "t1.nii.gz", folder_ / "labels.nii.gz"}, Towards::intraop, "out");
  expect_parts(notes[1], {"labels.nii.gz", "label map"});
  const ScalarImage warped = read_image(folder_ / "out/warped_t1.nii.gz"),
                    expected = read_image(*run_ / "register/warped.nii.gz");
  for (std::size_t v = 0; v < expected.voxels.size(); ++v) {  // the file holds the grid in single precision
    ASSERT_NEAR(warped.voxels[v], expected.voxels[v], 1e-3);
  }
  EXPECT_EQ(read_label_map(folder_ / "out/warped_labels.nii.gz").voxels,
            read_label_map(*run_ / "register/warped_labels.nii.gz").voxels);
  const ScalarImage like = builders::image(builders::grid({10, 12, 14}, {3, 3, 3}), builders::texture);
  write_image(folder_ / "like.nii.gz", like);
  warp({folder_ / "t1.nii.gz"}, Towards::intraop, "back", folder_ / "like.nii.gz");
  EXPECT_TRUE(same_geometry(read_image(folder_ / "back/warped_t1.nii.gz").geometry, like.geometry));
}

TEST_F(WarpFiles, OfASequenceOneStateIsWanted) {
  write("run.json", R"({"states": {"open": {}}})");
  expect_parts(
      refusal([&] { warp_files({.run = folder_, .files = {}, .like = {}, .options = {.grid = {}}}, folder_ / "out"); }),
      {"sequence", "states/NAME"});
}

TEST_F(WarpFiles, WhatLiesOutsideTheImageIsTold) {
  const fs::path file = write("points.csv", "# frame: LPS\nx,y,z\n3,-5,8\n500,0,0\n");
  expect_parts(warp({file}, Towards::intraop, "out").front(), {"2 points", "1 lie outside the run's image"});
}

TEST_F(WarpFiles, OfAnImageThatShowsLittleOfWhatMovesItIsTold) {
  const auto head = builders::head(builders::sinking);
  write_image(folder_ / "t1.nii.gz", head.t1);
  EXPECT_EQ(warp({folder_ / "t1.nii.gz"}, Towards::intraop, "out").front().find("warning"), std::string::npos);
  ScalarImage slice = builders::image(builders::grid({30, 30, 1}, {3, 3, 1}), builders::texture);
  write_image(folder_ / "slice.nii.gz", slice);
  expect_parts(warp({folder_ / "slice.nii.gz"}, Towards::intraop, "out").front(),
               {"slice.nii.gz: an image", "% of what moves comes from outside"});
  slice.geometry.origin.x() += 500;
  write_image(folder_ / "far.nii.gz", slice);
  expect_parts(warp({folder_ / "far.nii.gz"}, Towards::intraop, "out").front(), {"nothing in it moves"});
}

TEST_F(WarpFiles, FieldsOfAnEarlierRunAreRefused) {
  const fs::path file = write("points.csv", "# frame: LPS\nx,y,z\n3,-5,8\n"), later = folder_ / "later";
  fs::copy(run_->path(), later, fs::copy_options::recursive);
  const auto registered = [](const std::string& status) { return R"("register": {"status": ")" + status + "\"}"; };
  for (const auto& [status, taken] : {std::pair(registered("done"), true),
                                      {registered("kept"), true},
                                      {registered("outdated"), false},
                                      {std::string(), false}}) {
    write("later/run.json", "{\"stages\": {" + status + "}}");
    for (const fs::path& run : {later, later / "register"}) {
      const std::string said = refusal([&] {
        warp_files({.run = run, .files = {file}, .like = {}, .towards = Towards::intraop, .options = {.grid = {}}},
                   folder_ / "out");
      });
      EXPECT_EQ(said.empty(), taken) << status << said;
      EXPECT_EQ(said.find("run it again to the end") == std::string::npos, taken);
      fs::remove(folder_ / "out/warped_points.csv");
    }
  }
}

/// As an update of the same name leaves them.
TEST_F(WarpFiles, FieldsOfAnEarlierSolutionAreRefused) {
  const fs::path file = write("points.csv", "# frame: LPS\nx,y,z\n3,-5,8\n"), later = folder_ / "answered";
  fs::copy(run_->path(), later, fs::copy_options::recursive);
  fs::create_directory(later / "solve");
  const auto said = [&](const fs::path& run) {
    return refusal([&] {
      warp_files({.run = run, .files = {file}, .like = {}, .towards = Towards::intraop, .options = {.grid = {}}},
                 folder_ / "out");
    });
  };
  StageReport report;
  report.measures["solution_sha256"] = sha256_of_text("the first");
  write_stage_record(later / "register", record_of(StageId::registration, "", report, 1));
  write("answered/solve/solution.vtu", "the second");
  for (const fs::path& run : {later, later / "register", later / "register/", later / "register/."}) {
    expect_parts(said(run), {"register", "an earlier solution"});
  }
  fs::rename(later / "register", later / "own_fields");
  EXPECT_EQ(said(later / "own_fields"), "") << "whose solution lies elsewhere";
}

TEST_F(WarpFiles, FilesThatDifferInTheirEndingsAloneGoTogether) {
  const fs::path table = write("points.csv", "# frame: LPS\nx,y,z\n3,-5,8\n"),
                 model = write("points.obj", "v 3 -5 8\n");
  EXPECT_EQ(warp({table, model}, Towards::intraop, "out").size(), 2U);
}

TEST_F(WarpFiles, ValuesOfAnEarlierWarpOfTheFileGoWhereTheNextMakesNone) {
  const fs::path image = write("t1.nii.gz", ""), other = write("out/estimated_error_warped_t2.nii.gz", "");
  const fs::path stale = write("out/estimated_error_warped_t1.nii.gz", "");
  write("back/estimated_error_warped_t1.nii.gz", "");
  remove_values_of_earlier({image}, folder_ / "back", folder_ / "out");
  EXPECT_TRUE(fs::exists(stale));
  fs::remove(folder_ / "back/estimated_error_warped_t1.nii.gz");
  remove_values_of_earlier({image}, folder_ / "back", folder_ / "out");
  EXPECT_FALSE(fs::exists(stale));
  EXPECT_TRUE(fs::exists(other));
}

TEST_F(WarpFiles, NothingIsWrittenWhereAFileIsMissingOrTwoHaveOneName) {
  const fs::path file = write("points.csv", "# frame: LPS\nx,y,z\n3,-5,8\n");
  const fs::path other = write("other/points.csv", "# frame: LPS\nx,y,z\n3,-5,8\n");
  expect_parts(refusal([&] { warp({file, other}, Towards::intraop, "out"); }), {"other/points.csv", "rename"});
  expect_parts(refusal([&] { warp({file, folder_ / "none.tck"}, Towards::intraop, "out"); }), {"none.tck", "no such"});
  EXPECT_TRUE(fs::is_empty(folder_ / "out"));
}

}  // namespace brainshift::pipelines::warp_files_test
