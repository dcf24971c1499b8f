// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "pipelines/scene/presets.hpp"
#include "pipelines/tradeoff/choices.hpp"
#include "pipelines/tradeoff/front.hpp"
#include "pipelines/tradeoff/to_tolerance.hpp"

namespace brainshift::pipelines {
namespace {

TEST(Front, HoldsWhatIsNearerThanAllThatIsFaster) {
  const std::vector<CostAndError> points = {{3, 0.2}, {1, 0.5}, {2, 0.6}, {4, 0.1}, {1, 0.7}, {5, 0.3}};
  EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{1, 0, 3}));
}

TEST(Front, LeavesOutWhatIsNearerByLessThanAHundredth) {
  const std::vector<CostAndError> points = {{1, 0.5}, {2, 0.498}, {3, 0.4}};
  EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{0, 2}));
  EXPECT_TRUE(pareto_front({}).empty());
}

TEST(Choices, AreAllCombinationsWithTheCloudsOneAfterTheOther) {
  TradeoffLists lists;
  lists.nodes = "100, 200";
  lists.points_per_cell = "auto";
  lists.basis = "linear";
  lists.derivatives = "full";
  lists.precision = "double single";
  lists.tolerance = "0.1 0.01";
  const std::vector<Choice> choices = all_choices(lists);
  ASSERT_EQ(choices.size(), 8);
  EXPECT_EQ(name_of(choices[0]), "100-auto-0-linear-full-double-0.1");
  EXPECT_EQ(name_of(choices[3]), "100-auto-0-linear-full-single-0.01");
  EXPECT_EQ(choices[4][0], "200");
  EXPECT_EQ(reference_choice(lists).back(), "0.001");
}

/// The estimate is right for two solutions whose errors are of the order that it takes.
TEST(Estimate, IsTheErrorOfTheFinerSolution) {
  const double ratio = 1.7, coarse = 0.3, fine = coarse / std::pow(ratio, 1.5);
  const auto estimate = estimated_error({2 * (coarse - fine), coarse - fine, 0}, ratio, 0.01);
  EXPECT_NEAR(estimate.percentile_95, fine + 0.01, 1e-12);
  EXPECT_NEAR(estimate.largest, 2 * fine + 0.01, 1e-12);
}

TEST(Estimate, LeadsToTheNodesThatReachTheTolerance) {
  const Level level{4000, 8, 1, {1, 0.36, 0.1}};
  EXPECT_NEAR(static_cast<double>(next_nodes(level, 0.2)), 4000 * std::pow(0.36 / 0.18, 2), 1);
  EXPECT_EQ(next_nodes(level, 0.35), 8000) << "a level is worth its time only when it is finer by a factor";
  EXPECT_EQ(next_nodes(level, 0.001), 32000);
}

TEST(Presets, AreKnownByName) {
  EXPECT_TRUE(preset_overrides("").empty());
  EXPECT_NE(preset_overrides("fast"), preset_overrides("accurate"));
  EXPECT_THROW(preset_overrides("quick"), std::invalid_argument);
}

}  // namespace
}  // namespace brainshift::pipelines
