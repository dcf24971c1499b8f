// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/tradeoff/to_tolerance.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace brainshift::pipelines::to_tolerance_test {

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

}  // namespace brainshift::pipelines::to_tolerance_test
