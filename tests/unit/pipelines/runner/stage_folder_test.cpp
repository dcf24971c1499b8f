// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/stage_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/unit/expect_parts.hpp"
#include "tests/unit/pipelines/run_folder.hpp"

namespace brainshift::pipelines::stage_folder_test {

class StageFolderTest : public RunFolder {};

TEST_F(StageFolderTest, AnUnfinishedStageLeavesNothingBehind) {
  { StageFolder unfinished(folder_ / "stage", interruption_); }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(StageFolderTest, AFinishedStageTakesThePlaceOfTheOneBefore) {
  write("stage/old", "old");
  StageFolder finished(folder_ / "stage", interruption_);
  std::ofstream(finished.path() / "new") << "new";
  finished.replace();
  EXPECT_TRUE(fs::exists(folder_ / "stage/new"));
  EXPECT_FALSE(fs::exists(folder_ / "stage/old"));
}

TEST_F(StageFolderTest, ASingleStageKeepsOtherFilesOfItsFolder) {
  write("stage/mine", "mine");
  write("stage/made", "old");
  StageFolder finished(folder_ / "stage", interruption_);
  std::ofstream(finished.path() / "made") << "new";
  finished.merge();
  EXPECT_EQ(read(folder_ / "stage/mine"), "mine");
  EXPECT_EQ(read(folder_ / "stage/made"), "new");
}

TEST_F(StageFolderTest, ASingleStageDoesNotTakeThePlaceOfAnothersFile) {
  write("stage/labels", "a patient's");
  write("stage/same", "same");
  StageFolder finished(folder_ / "stage", interruption_);
  std::ofstream(finished.path() / "same") << "same";
  EXPECT_NO_THROW(finished.refuse_others_files());
  std::ofstream(finished.path() / "labels") << "ours";
  try {
    finished.refuse_others_files();
    FAIL() << "no fault";
  } catch (const std::invalid_argument& fault) {
    test::expect_parts(fault.what(), {"stage/labels", "another file of that name"});
  }
  EXPECT_EQ(read(folder_ / "stage/labels"), "a patient's");
}

TEST_F(StageFolderTest, ASingleStageWritesAFolderAnewUnlessOtherFilesWouldBeAmongIts) {
  write("stage/series/1", "old");
  {
    StageFolder finished(folder_ / "stage", interruption_);
    fs::create_directory(finished.path() / "series");
    std::ofstream(finished.path() / "series/1") << "new";
    std::ofstream(finished.path() / "series/2") << "new";
    finished.merge();
  }
  EXPECT_EQ(read(folder_ / "stage/series/1"), "new");
  EXPECT_EQ(read(folder_ / "stage/series/2"), "new");
  StageFolder shorter(folder_ / "stage", interruption_);
  fs::create_directory(shorter.path() / "series");
  std::ofstream(shorter.path() / "series/1") << "newer";
  brainshift::test::expect_parts(brainshift::test::refusal([&] { shorter.merge(); }),
                                 {(folder_ / "stage/series").string(), "holds a 2", "--out"});
  EXPECT_EQ(read(folder_ / "stage/series/1"), "new");
}

TEST_F(StageFolderTest, WhatSomebodyElsePutInItsPlaceStays) {
  write("stage.partial/precious", "mine");
  brainshift::test::expect_parts(
      brainshift::test::refusal([&] { StageFolder folder(folder_ / "stage", interruption_); }),
      {(folder_ / "stage.partial").string(), "not made by brainshift"});
  EXPECT_EQ(read(folder_ / "stage.partial/precious"), "mine");
}

TEST_F(StageFolderTest, TakesOverWhatAKilledRunLeft) {
  write("stage.partial/.unfinished", "");
  write("stage.partial/half", "x");
  StageFolder folder(folder_ / "stage", interruption_);
  EXPECT_FALSE(fs::exists(folder.path() / "half"));
}

TEST_F(StageFolderTest, HasAPlaceWithAName) {
  EXPECT_EQ(place_of(folder_ / "stage/"), folder_ / "stage");
  brainshift::test::expect_parts(brainshift::test::refusal([] { place_of(""); }), {"no name", "--out"});
}

TEST_F(StageFolderTest, NoTwoWriteTheSameStage) {
  StageFolder first(folder_ / "stage", interruption_);
  std::ofstream(first.path() / "made") << "first";
  EXPECT_THROW(StageFolder(folder_ / "stage", interruption_), std::runtime_error);
  first.merge();
  EXPECT_EQ(read(folder_ / "stage/made"), "first");
  EXPECT_FALSE(fs::exists(folder_ / "stage/.unfinished"));
}

}  // namespace brainshift::pipelines::stage_folder_test
