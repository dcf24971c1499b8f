// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/stage_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace brainshift::pipelines::stage_folder_test {

namespace fs = std::filesystem;

class StageFolderTest : public testing::Test {
 protected:
  StageFolderTest() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / ("brainshift_runner_" + std::string(info->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~StageFolderTest() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  static std::string read(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  fs::path folder_;
  Interruption interruption_{[](int) {}};
};

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

}  // namespace brainshift::pipelines::stage_folder_test
