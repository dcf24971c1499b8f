// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/run_data.hpp"

#include <gtest/gtest.h>

#include "tests/unit/expect_parts.hpp"
#include "tests/unit/pipelines/report/small_run.hpp"
#include "tests/unit/pipelines/run_folder.hpp"

namespace brainshift::pipelines::run_data_test {

class RunDataTest : public RunFolder {};

TEST_F(RunDataTest, PartsThatTheRunDidNotMakeAreEmpty) {
  write("run.json", "{}");
  write("solve/history.csv", "step,time\n1,1\n");
  write("solve/uncertainty.csv", "x,y,z\n");
  const RunData run = read_run(folder_);
  EXPECT_EQ(run.uncertainty, "x,y,z\n");
  EXPECT_EQ(run.history, "step,time\n1,1\n");
  EXPECT_EQ(run.load, "");
  EXPECT_FALSE(run.t1 || run.warped || run.forward || run.brain || run.solution || run.labels || run.warped_labels ||
               run.jacobian);
  EXPECT_EQ(dynamics_of(run.record), solve::Dynamics::relaxation);
}

TEST_F(RunDataTest, OfASequenceOneStateIsWanted) {
  write("run.json", R"({"states": {"open": {}}})");
  test::expect_parts(test::refusal([&] { read_run(folder_); }), {"sequence", "states/NAME"});
}

TEST(RunData, LoadedIsWhatHasAReaction) {
  EXPECT_EQ(loaded_positions(*small_run().solution).rows(), 13);
}

}  // namespace brainshift::pipelines::run_data_test
