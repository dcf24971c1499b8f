// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/region/region.hpp"

#include <gtest/gtest.h>

#include "tests/unit/solve/models.hpp"
#include "tests/unit/solve/pressed_bar.hpp"

namespace brainshift::solve::region_test {

TEST(Region, DiffersFromTheWholeByLessThanItself) {
  const Model model = pressed_bar();
  SolveOptions options;
  options.shape.basis = Basis::linear;
  const SolveResult whole = solve(model, options);
  ASSERT_TRUE(whole.failure.empty()) << whole.failure;
  options.region = 1;
  const SolveResult part = solve(model, options);
  ASSERT_TRUE(part.failure.empty()) << part.failure;
  EXPECT_LT(part.measures.region_nodes, 2 * model.cloud.size() / 3);
  EXPECT_GT(part.measures.region_nodes, 0u);
  EXPECT_EQ(part.solution.displacement.rows(), whole.solution.displacement.rows());
  const double difference = largest_difference_of(part, whole);
  EXPECT_LT(difference, options.region);
  EXPECT_GT(difference, 0);
  EXPECT_LT(part.measures.pairs, 3 * whole.measures.pairs / 4) << "what most of the memory goes to";
  EXPECT_NEAR(part.history.back().reaction.z(), whole.history.back().reaction.z(),
              0.1 * std::abs(whole.history.back().reaction.z()));
}

TEST(Region, OfEverythingIsTheWholeBitForBit) {
  const Model model = pressed_bar();
  SolveOptions options;
  options.shape.basis = Basis::linear;
  options.max_steps = 200;  // they need not come to rest
  const SolveResult whole = solve(model, options);
  options.region = 1e-9;
  const SolveResult part = solve(model, options);
  EXPECT_EQ(part.measures.region_nodes, model.cloud.size());
  EXPECT_EQ(largest_difference_of(part, whole), 0);
}

TEST(Region, LargerThanAnyDisplacementIsAnError) {
  SolveOptions options;
  options.region = 5;
  EXPECT_THROW(solve(pressed_bar(), options), std::invalid_argument);
}

TEST(Region, RefusesWhatMovesTheWholeBody) {
  Model model = pressed_bar();
  SolveOptions options;
  options.region = 0.5;
  model.gravity = {0, 0, -9.81};
  EXPECT_THROW(solve(model, options), std::invalid_argument);
  model.gravity.setZero();
  options.dynamics = Dynamics::transient;
  EXPECT_THROW(solve(model, options), std::invalid_argument);
}

}  // namespace brainshift::solve::region_test
