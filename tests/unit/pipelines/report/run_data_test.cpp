// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/run_data.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/pipelines/report/small_run.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::pipelines::run_data_test {

TEST(RunData, AHistoryIsReadByTheNamesOfItsColumns) {
  const brainshift::test::ScratchFolder folder;
  const auto rows =
      read_history(folder.write("h.csv", "time,step,mine,reaction_z_N,error_bound_mm\n0.5,20,7,-3,inf\n"));
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].time, 0.5);
  EXPECT_EQ(rows[0].step, 20);
  EXPECT_EQ(rows[0].reaction, Eigen::Vector3d(0, 0, -3));
  EXPECT_TRUE(std::isinf(rows[0].error_bound));
  EXPECT_EQ(rows[0].dissipated_energy, 0) << "a column that is not there";
  const std::pair<const char*, const char*> faults[] = {{"step\n1\n", "no column 'time'"},
                                                        {"step,time\n1\n", "h.csv:2: 2 numbers"},
                                                        {"step,time\n1,2\n3,x\n", "h.csv:3: time is 'x'"}};
  for (const auto& [text, said] : faults) {
    try {
      read_history(folder.write("h.csv", text));
      FAIL() << text;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
    }
  }
}

TEST(RunData, LoadedAreTheNodesWithAReaction) {
  const RunData run = test::small_run();
  const Points loaded = loaded_positions(*run.solution);
  EXPECT_EQ(loaded.rows(), 13);
  EXPECT_EQ(loaded.col(2).minCoeff(), 20);
}

TEST(RunData, TheDisplacementAtANodeIsItsOwnAndBetweenNodesThatAround) {
  const Solution solution = *test::small_run().solution;
  Points places(2, 3);
  places << 0, 0, 20, 2.5, 2.5, 20;
  const Points u = displacement_at(solution, places);
  EXPECT_NEAR(u(0, 2), -4, 1e-9);
  EXPECT_LT(u(1, 2), -3);
  EXPECT_GE(u(1, 2), -4);
}

TEST(RunData, DynamicsAreThoseOfTheOptionsOrRelaxation) {
  EXPECT_EQ(dynamics_of(nlohmann::json::object()), solve::Dynamics::relaxation);
  EXPECT_EQ(dynamics_of({{"options", {{"solve", {{"dynamics", "transient"}}}}}}), solve::Dynamics::transient);
}

}  // namespace brainshift::pipelines::run_data_test
