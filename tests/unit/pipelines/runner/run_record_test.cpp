// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/run_record.hpp"

#include <gtest/gtest.h>

#include "pipelines/runner/plan.hpp"
#include "pipelines/runner/stage_folder.hpp"
#include "pipelines/runner/stage_record.hpp"
#include "tests/unit/pipelines/run_folder.hpp"

namespace brainshift::pipelines::run_record_test {

class RunRecordTest : public RunFolder {};

TEST_F(RunRecordTest, AStageRecordReadsBackAndADamagedOneIsNone) {
  write("brain.vtp", "surface");
  write_stage_record(
      folder_,
      {.stage = "segment", .stamp = "stamp", .failure = "failure", .entry = {{"status", "failed"}}, .artefacts = {}});
  const auto record = read_stage_record(folder_);
  ASSERT_TRUE(record);
  EXPECT_EQ(record->stage, "segment");
  EXPECT_EQ(record->stamp, "stamp");
  EXPECT_EQ(record->failure, "failure");
  EXPECT_EQ(record->entry["status"], "failed");
  EXPECT_EQ(record->artefacts["brain.vtp"]["bytes"], 7);
  const auto whole = nlohmann::ordered_json::parse(read(folder_ / "stage.json"));
  write("stage.json", "{\"stamp\": ");
  EXPECT_FALSE(read_stage_record(folder_));
  for (const auto& [name, value] : whole.items()) {
    auto damaged = whole;
    damaged[name] = 5;
    write("stage.json", damaged.dump());
    EXPECT_EQ(read_stage_record(folder_).has_value(), name == "version") << name;
  }
}

}  // namespace brainshift::pipelines::run_record_test
