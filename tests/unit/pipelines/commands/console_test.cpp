// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/commands/console.hpp"

#include <gtest/gtest.h>

namespace brainshift::pipelines::console_test {

using testing::internal::CaptureStderr;
using testing::internal::GetCapturedStderr;
using namespace std::chrono_literals;

TEST(Console, GoesOnShowingWhatHasNothingNewToSay) {
  CaptureStderr();
  Console console(false, false, 1ms);
  console.started(StageId::solve);
  console.progress(StageId::solve, 0, "evaluating shape functions");
  std::this_thread::sleep_for(300ms);
  console.finished(StageId::solve, 300);
  const std::string shown = GetCapturedStderr();
  const std::string line = "solve 0 %, evaluating shape functions, 0.";
  const std::size_t first = shown.find(line);
  ASSERT_NE(first, std::string::npos) << shown;
  EXPECT_NE(shown.find(line, first + 1), std::string::npos) << shown;
  EXPECT_TRUE(shown.starts_with("solve ...\n") && shown.ends_with("solve: done in 5 min 0 s\n")) << shown;
  EXPECT_EQ(shown.find("left"), std::string::npos) << shown;
}

TEST(Console, ShowsNothingBetweenStages) {
  CaptureStderr();
  Console console(false, false, 1ms);
  console.progress(StageId::solve, 0.5, "step 20");
  console.failed(StageId::solve);
  GetCapturedStderr();
  CaptureStderr();
  std::this_thread::sleep_for(50ms);
  EXPECT_EQ(GetCapturedStderr(), "");
}

TEST(Console, IsSilentWhenQuiet) {
  CaptureStderr();
  Console console(true, true, 1ms);
  console.started(StageId::solve);
  console.progress(StageId::solve, 0.5, "step 20");
  std::this_thread::sleep_for(50ms);
  console.finished(StageId::solve, 1);
  EXPECT_EQ(GetCapturedStderr(), "");
}

TEST(TimeLeft, CountsFromWhereTheFractionBeganToGrow) {
  TimeLeft left;
  left.note(0, 0);
  left.note(0, 100);
  EXPECT_FALSE(left.at(100));
  left.note(0.1, 200);
  EXPECT_FALSE(left.at(200));
  left.note(0.3, 210);
  EXPECT_NEAR(left.at(210).value(), 35, 1e-9);
  EXPECT_NEAR(left.at(220).value(), 25, 1e-9);
  EXPECT_FALSE(left.at(250));
  left.note(0.01, 260);  // once more, with other settings
  EXPECT_FALSE(left.at(270));
  left.note(0.51, 270);
  EXPECT_NEAR(left.at(270).value(), 9.8, 1e-9);
}

}  // namespace brainshift::pipelines::console_test
