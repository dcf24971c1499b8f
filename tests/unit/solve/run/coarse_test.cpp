// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/coarse.hpp"

#include <gtest/gtest.h>

#include "solve/body/ordered_cloud.hpp"
#include "tests/unit/solve/models.hpp"
#include "tests/unit/solve/pressed_bar.hpp"

namespace brainshift::solve::coarse_test {

TEST(CoarseStart, EndsWhereTheStartFromRestEndsInFewerSteps) {
  const Model model = pressed_bar();
  SolveOptions options;
  options.tolerance = 0.001;
  const SolveResult from_rest = solve(model, options);
  options.start = Start::coarse;
  const SolveResult from_coarse = solve(model, options);
  ASSERT_TRUE(from_coarse.failure.empty()) << from_coarse.failure;
  EXPECT_LT(from_coarse.measures.steps, 3 * from_rest.measures.steps / 4);
  EXPECT_LT(largest_difference_of(from_coarse, from_rest), 2 * options.tolerance);
  EXPECT_GT(from_coarse.measures.seconds_coarse, 0);
  EXPECT_EQ(from_rest.measures.seconds_coarse, 0);
  EXPECT_NEAR(from_coarse.history.back().strain_energy, from_rest.history.back().strain_energy,
              0.01 * from_rest.history.back().strain_energy);
}

TEST(CoarseStart, IsFromRestWhereTheWayThereIsWanted) {
  const Model model = pressed_bar();
  SolveOptions options;
  options.start = Start::coarse;
  options.snapshot_every = 100;
  const SolveResult result = solve(model, options);
  EXPECT_EQ(result.measures.seconds_coarse, 0);
  EXPECT_LT(result.history.front().time, 1);
}

TEST(CoarseStart, IsFromRestWhereTheLoadDoesNotEndInFull) {
  Model model = pressed_bar();
  model.curve = LoadCurve({0, 1}, {0, 0.5}, LoadCurve::Join::smooth);
  SolveOptions options;
  const SolveResult from_rest = solve(model, options);
  options.start = Start::coarse;
  const SolveResult result = solve(model, options);
  EXPECT_TRUE(result.failure.empty()) << result.failure;
  EXPECT_EQ(result.measures.seconds_coarse, 0);
  EXPECT_EQ(largest_difference_of(result, from_rest), 0);
}

/// Held at three neighbours, of which a coarse cloud has one.
TEST(CoarseStart, IsFromRestWhereTheCoarseCloudIsNotHeld) {
  Model model = pressed_bar();
  const Eigen::Index corner = 9 * 9 * 20;
  model.conditions.displacement.setConstant(std::nan(""));
  for (const Eigen::Index node : {corner, corner + 1, corner + 9}) {
    model.conditions.displacement.row(node).setZero();
  }
  model.gravity = {0, 0, 0.01};
  SolveOptions options;
  options.max_steps = 40;  // it need not come to rest
  const SolveResult from_rest = solve(model, options);
  options.start = Start::coarse;
  const SolveResult result = solve(model, options);
  EXPECT_GT(result.measures.seconds_coarse, 0);
  EXPECT_GT(result.measures.largest_displacement, 0);
  EXPECT_EQ(largest_difference_of(result, from_rest), 0);
}

TEST(Region, CoarseNodesAreAnEvenEighth) {
  const NodeCloud cloud = test::irregular_box(21, 100);
  const std::vector<std::int32_t> nodes = coarse_nodes(cloud, {});
  EXPECT_GT(nodes.size(), cloud.size() / 12);
  EXPECT_LT(nodes.size(), cloud.size() / 4);
  const NodeCloud coarse = subset(cloud, nodes);
  for (Eigen::Index a = 0; a < coarse.positions.rows(); ++a) {
    for (Eigen::Index b = 0; b < a; ++b) {
      EXPECT_GT((coarse.positions.row(a) - coarse.positions.row(b)).norm(), 1.4 * 5);
    }
  }
}

}  // namespace brainshift::solve::coarse_test
