// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/region/region.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::region_test {

/// A bar of 8 × 8 × 20 spacings, held on the surface of its far two thirds and pressed in at the middle of the near
/// end: what moves is near.
Model pressed_bar() {
  constexpr double h = 5;
  const Eigen::Vector3i steps(8, 8, 20);
  const Eigen::Vector3d size = h * steps.cast<double>();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> within(-0.25 * h, 0.25 * h);
  Model model;
  NodeCloud& cloud = model.cloud;
  const Eigen::Index nodes = (steps.array() + 1).prod();
  cloud.positions.resize(nodes, 3);
  Points& prescribed = model.conditions.displacement;
  prescribed = Points::Constant(nodes, 3, std::nan(""));
  for (Eigen::Index a = 0; a < nodes; ++a) {
    const Eigen::Vector3i i(static_cast<int>(a % 9), static_cast<int>(a / 9 % 9), static_cast<int>(a / 81));
    bool on_surface = false;
    for (int axis = 0; axis < 3; ++axis) {
      const bool at_face = i[axis] == 0 || i[axis] == steps[axis];
      on_surface = on_surface || at_face;
      cloud.positions(a, axis) = h * i[axis] + (at_face ? 0 : within(random));
    }
    cloud.on_surface.push_back(on_surface ? 1 : 0);
    if (on_surface && i.z() > 6) {
      prescribed.row(a).setZero();
    } else if (const int r = (i.head<2>().array() - 4).square().sum(); i.z() == 0 && r <= 9) {
      prescribed.row(a) << 0, 0, 4 * (1 - r / 16.0);
    }
  }
  cloud.spacing.assign(cloud.on_surface.size(), h);
  model.cells = test::box_cells(steps, size);
  model.materials[1] = {3000, 0.4, 1000};
  return model;
}

double largest_difference_of(const SolveResult& a, const SolveResult& b) {
  return (a.solution.displacement - b.solution.displacement).rowwise().norm().maxCoeff();
}

TEST(Region, DiffersFromTheWholeByLessThanItself) {
  const Model model = pressed_bar();
  SolveOptions options;
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
