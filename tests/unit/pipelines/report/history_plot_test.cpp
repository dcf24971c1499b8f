// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/history_plot.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace brainshift::pipelines::history_plot_test {

using solve::HistoryRow;

std::vector<HistoryRow> loaded_in_the_second_of_three() {
  std::vector<HistoryRow> rows(3);
  for (int i = 0; i < 3; ++i) {
    HistoryRow& row = rows[static_cast<std::size_t>(i)];
    row.step = 100 * i;
    row.time = 0.5 + 0.5 * i;
    row.error_bound = i == 0 ? std::numeric_limits<double>::infinity() : 1.0 / i;
    row.residual = 0.1;
    row.external_work = i;
    row.kinetic_energy = 0.5;
  }
  return rows;
}

TEST(HistoryPlot, ConvergenceHasTheLoadingPhaseAndTheTolerance) {
  const auto plot = convergence_plot(loaded_in_the_second_of_three(), 0.02);
  ASSERT_TRUE(plot);
  EXPECT_EQ(plot->scale, Scale::log_y);
  EXPECT_EQ(plot->series[0].x, (std::vector<double>{0, 100, 200}));
  EXPECT_EQ(plot->series[0].y[2], 0.5);
  ASSERT_TRUE(plot->phase);
  EXPECT_EQ(plot->phase->to, 100);
  ASSERT_TRUE(plot->level);
  EXPECT_EQ(plot->level->y, 0.02);
}

TEST(HistoryPlot, ThereIsNoPhaseAfterACoarseStartAndNoToleranceOfZero) {
  auto rows = loaded_in_the_second_of_three();
  rows.erase(rows.begin());
  const auto plot = convergence_plot(rows, 0);
  ASSERT_TRUE(plot);
  EXPECT_FALSE(plot->phase);
  EXPECT_FALSE(plot->level);
}

TEST(HistoryPlot, EnergiesAreOverTimeForATransientRunAndElseOverTheSteps) {
  const auto rows = loaded_in_the_second_of_three();
  EXPECT_EQ(energy_plot(rows, solve::Dynamics::transient)->series[0].x, (std::vector<double>{0.5, 1, 1.5}));
  const auto plot = energy_plot(rows, solve::Dynamics::relaxation);
  EXPECT_EQ(plot->series[0].x, (std::vector<double>{0, 100, 200}));
  EXPECT_EQ(plot->series[0].y, (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(plot->series[2].y, (std::vector<double>{0.5, 0.5, 0.5}));
}

TEST(HistoryPlot, ThereIsNoneOfOneRowOrOfNothing) {
  auto rows = loaded_in_the_second_of_three();
  rows.resize(1);
  EXPECT_FALSE(convergence_plot(rows, 0.02));
  EXPECT_FALSE(energy_plot(rows, solve::Dynamics::relaxation));
  EXPECT_FALSE(energy_plot(std::vector<HistoryRow>(5), solve::Dynamics::relaxation));
}

}  // namespace brainshift::pipelines::history_plot_test
