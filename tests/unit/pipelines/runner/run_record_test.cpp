// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/run_record.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "pipelines/runner/plan.hpp"
#include "pipelines/runner/stage_folder.hpp"
#include "tests/unit/pipelines/run_folder.hpp"

namespace brainshift::pipelines::run_record_test {

class RunRecord : public RunFolder {};

TEST_F(RunRecord, AStageRecordReadsBackAndADamagedOneIsNone) {
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
