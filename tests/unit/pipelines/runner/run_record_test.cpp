// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/run_record.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "pipelines/runner/plan.hpp"
#include "pipelines/runner/stage_folder.hpp"

namespace brainshift::pipelines::run_record_test {

namespace fs = std::filesystem;

class RunRecordTest : public testing::Test {
 protected:
  RunRecordTest() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / ("brainshift_runner_" + std::string(info->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~RunRecordTest() override { fs::remove_all(folder_); }

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

TEST_F(RunRecordTest, AStageRecordReadsBackAndADamagedOneIsNone) {
  write_stage_record(folder_, {"stamp", "failure", {{"status", "failed"}}});
  const auto record = read_stage_record(folder_);
  ASSERT_TRUE(record);
  EXPECT_EQ(record->stamp, "stamp");
  EXPECT_EQ(record->failure, "failure");
  EXPECT_EQ(record->entry["status"], "failed");
  write("stage.json", "{\"stamp\": ");
  EXPECT_FALSE(read_stage_record(folder_));
}

}  // namespace brainshift::pipelines::run_record_test
