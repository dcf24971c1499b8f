// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/run_data.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "pipelines/runner/stage_folder.hpp"
#include "tests/unit/pipelines/run_folder.hpp"

namespace brainshift::pipelines::run_data_test {

class RunData : public RunFolder {};

TEST_F(RunData, AHistoryIsReadByTheNamesOfItsColumns) {
  const auto rows = read_history(write("h.csv", "time,step,mine,reaction_z_N,error_bound_mm\n0.5,20,7,-3,inf\n"));
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].time, 0.5);
  EXPECT_EQ(rows[0].step, 20);
  EXPECT_EQ(rows[0].reaction, Eigen::Vector3d(0, 0, -3));
  EXPECT_TRUE(std::isinf(rows[0].error_bound));
  EXPECT_EQ(rows[0].dissipated_energy, 0) << "a column that is not there";
  const std::pair<const char*, const char*> faults[] = {{"step\n1\n", "no column 'time'"},
                                                        {"step,time\n1\n", "line 2: 2 numbers"},
                                                        {"step,time\n1,2\n3,x\n", "line 3: time is 'x'"}};
  for (const auto& [text, said] : faults) {
    try {
      read_history(write("h.csv", text));
      FAIL() << text;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
    }
  }
}

}  // namespace brainshift::pipelines::run_data_test
