// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/stage_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include "tests/unit/pipelines/run_folder.hpp"

namespace brainshift::pipelines::stage_folder_test {

class StageFolder : public RunFolder {};

TEST_F(StageFolder, AnUnfinishedStageLeavesNothingBehind) {
  { StageFolder unfinished(folder_ / "stage", interruption_); }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(StageFolder, AFinishedStageTakesThePlaceOfTheOneBefore) {
  write("stage/old", "old");
  StageFolder finished(folder_ / "stage", interruption_);
  std::ofstream(finished.path() / "new") << "new";
  finished.replace();
  EXPECT_TRUE(fs::exists(folder_ / "stage/new"));
  EXPECT_FALSE(fs::exists(folder_ / "stage/old"));
}

TEST_F(StageFolder, ASingleStageKeepsOtherFilesOfItsFolder) {
  write("stage/mine", "mine");
  write("stage/made", "old");
  StageFolder finished(folder_ / "stage", interruption_);
  std::ofstream(finished.path() / "made") << "new";
  finished.merge();
  EXPECT_EQ(read(folder_ / "stage/mine"), "mine");
  EXPECT_EQ(read(folder_ / "stage/made"), "new");
}

}  // namespace brainshift::pipelines::stage_folder_test
