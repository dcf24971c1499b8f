// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/tradeoff/tradeoff_files.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::pipelines::tradeoff_files_test {

using brainshift::test::bytes_of;

TradeoffPoint point(const std::string& nodes, double seconds, double error) {
  return {.choice = {nodes, "auto", "0", "linear", "full", "double", "0.1"},
          .failure = {},
          .nodes = 100,
          .points = 400,
          .steps = 30,
          .solve_seconds = seconds,
          .whole_seconds = seconds + 10,
          .error = {2 * error, error, error / 2},
          .landmark_error = std::nan("")};
}

// The third is slower and worse than the second; the last was not solved.
Sweep small_sweep() {
  Sweep sweep{.reference = point("9000", 0, 0).choice,
              .points = {point("100", 1, 0.8), point("200", 2, 0.4), point("300", 3, 0.5), point("400", 0, 0)}};
  sweep.points[3].failure = "it said \"no\", twice";
  return sweep;
}

TEST(TradeoffFiles, TheFrontLeavesOutWhatIsWorseAndWhatFailed) {
  EXPECT_EQ(front_of(small_sweep(), TradeoffTime::solve), (std::vector<std::size_t>{0, 1}));
}

TEST(TradeoffFiles, TheFrontInWordsSaysTimesErrorsAndWhatMoreTimeBuys) {
  const std::string words = front_in_words(small_sweep(), TradeoffTime::solve);
  EXPECT_NE(words.find("1 s of solve (11 s in all) buy an error of 0.8 mm"), std::string::npos) << words;
  EXPECT_NE(words.find("2 times the time of the one before for 0.5 of its error"), std::string::npos) << words;
}

TEST(TradeoffFiles, TableAndPicturesAreWritten) {
  const brainshift::test::ScratchFolder folder;
  write_tradeoff(folder.path(), small_sweep());
  const std::string csv = bytes_of(folder / "tradeoff.csv");
  EXPECT_EQ(std::ranges::count(csv, '\n'), 5);
  EXPECT_NE(csv.find("200,auto,0,linear,full,double,0.1,100,400,30,2,12,0.8,0.4,0.2,,1,1,\n"), std::string::npos)
      << csv;
  EXPECT_NE(csv.find("\"it said \"\"no\"\", twice\""), std::string::npos) << csv;
  const std::string text = bytes_of(folder / "tradeoff.md");
  EXPECT_NE(text.find("![](tradeoff_solve.svg)"), std::string::npos);
  EXPECT_NE(bytes_of(folder / "tradeoff_run.svg").find("whole run"), std::string::npos);
  EXPECT_THROW(write_tradeoff(folder / "none", small_sweep()), std::runtime_error);
}

}  // namespace brainshift::pipelines::tradeoff_files_test
