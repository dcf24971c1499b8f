// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/output/history.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::solve::history_test {

std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::istringstream text(test::bytes_of(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) {
    lines.push_back(line);
  }
  return lines;
}

TEST(History, IsARowALookUnderANameAndAUnitEach) {
  const test::ScratchFolder folder;
  const HistoryRow row{.step = 20,
                       .time = 0.25,
                       .external_work = 1,
                       .strain_energy = 2,
                       .kinetic_energy = 3,
                       .dissipated_energy = 4,
                       .reaction = {5, 6, 7},
                       .residual = 8,
                       .error_bound = 9};
  write_history(folder / "history.csv", {row, HistoryRow()});
  const std::vector<std::string> lines = lines_of(folder / "history.csv");
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0],
            "step,time,external_work_mJ,strain_energy_mJ,kinetic_energy_mJ,residual,error_bound_mm,"
            "dissipated_energy_mJ,reaction_x_N,reaction_y_N,reaction_z_N");
  EXPECT_EQ(lines[1], "20,0.25,1,2,3,8,9,4,5,6,7");
}

TEST(History, KeepsNineDigitsAndSaysWhereABoundIsNotKnown) {
  const test::ScratchFolder folder;
  HistoryRow row;
  row.strain_energy = 0.123456789123;
  row.error_bound = std::numeric_limits<double>::infinity();
  write_history(folder / "history.csv", {row});
  EXPECT_EQ(lines_of(folder / "history.csv")[1], "0,0,0,0.123456789,0,0,inf,0,0,0,0");
}

TEST(History, ThatCannotBeWrittenIsAFaultThatNamesTheFile) {
  const test::ScratchFolder folder;
  for (const std::filesystem::path& file : {folder / "none" / "history.csv", std::filesystem::path("/dev/full")}) {
    try {
      write_history(file, {HistoryRow()});
      FAIL() << file << " was written";
    } catch (const std::runtime_error& fault) {
      EXPECT_EQ(std::string(fault.what()).find(file.string() + ": could not be written whole"), 0U) << fault.what();
    }
  }
}

}  // namespace brainshift::solve::history_test
