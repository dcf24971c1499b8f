// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/solve_cost.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace brainshift::pipelines::solve_cost_test {

constexpr SolveSize head{.volume = 1.2e6, .nodes = 12000, .points = 75000, .pairs = 3.5e6};

/// The cost of a part; nothing of one that is not there.
PartCost cost_of(const std::vector<PartCost>& costs, const std::string& part) {
  const auto found = std::ranges::find(costs, part, &PartCost::part);
  return found == costs.end() ? PartCost{} : *found;
}

double bytes(const std::vector<PartCost>& costs) {
  return std::accumulate(costs.begin(), costs.end(), 0.0, [](double sum, const PartCost& c) { return sum + c.bytes; });
}

TEST(SolveCosts, HaveARowForEachPartThatTheSceneNames) {
  Scene scene;
  const std::size_t without = solve_costs(scene, head).size();
  for (const char* part : {"essential conditions", "contact", "gravity", "relaxation of the materials"}) {
    EXPECT_EQ(cost_of(solve_costs(scene, head), part).bytes, 0) << part;
  }
  scene.load.emplace();
  scene.contact.emplace();
  scene.loading.gravity.z() = -9.81;
  EXPECT_EQ(solve_costs(scene, head).size(), without + 3);
  EXPECT_EQ(cost_of(solve_costs(scene, head), "contact").named, "contact");
  EXPECT_EQ(cost_of(solve_costs(scene, head), "gravity").named, "solve.gravity");
  EXPECT_GT(cost_of(solve_costs(scene, head), "essential conditions").nanoseconds, 0);
  scene.solve.volumetric = solve::Volumetric::pointwise;
  EXPECT_EQ(solve_costs(scene, head).size(), without + 2) << "no pressure patches";
}

TEST(SolveCosts, OfTheDemosHeadAreWhatItsRunMeasured) {
  Scene scene;
  scene.contact.emplace();
  const std::vector<PartCost> costs = solve_costs(scene, {1.2e6, 12000, 75750, 3.5e6});
  EXPECT_NEAR(cost_of(costs, "shape functions and stress").bytes, 64.3e6, 3e6);
  EXPECT_NEAR(cost_of(costs, "nodal vectors and scratch").bytes, 4.8e6, 0.3e6);
  EXPECT_NEAR(cost_of(costs, "pressure patches").bytes, 2.4e6, 0.2e6);
  EXPECT_NEAR(cost_of(costs, "contact").bytes, 8.4e6, 3e6) << "its brain is no ball";
}

TEST(SolveCosts, OfPairsAreAboutHalfInSinglePrecision) {
  Scene scene;
  scene.solve.precision = solve::Precision::double_precision;
  const PartCost twice = solve_costs(scene, head)[0];
  scene.solve.precision = solve::Precision::single_precision;
  const PartCost once = solve_costs(scene, head)[0];
  EXPECT_LT(once.bytes, 0.65 * twice.bytes);
  EXPECT_LT(once.nanoseconds, 0.75 * twice.nanoseconds);
}

TEST(SolveCosts, OfRelaxationGrowWithItsTermsAndAreNoneAtRest) {
  Scene scene;
  scene.tissues = {{1, "", "", {}}, {7, "", "", {}}};
  scene.tissues[1].material.prony = {{0.5, 1}};
  EXPECT_EQ(cost_of(solve_costs(scene, head), "relaxation of the materials").bytes, 0) << "all has relaxed";
  scene.solve.dynamics = solve::Dynamics::transient;
  const PartCost one = cost_of(solve_costs(scene, head), "relaxation of the materials");
  EXPECT_EQ(one.named, "tissues.7");
  scene.tissues[1].material.prony.push_back({0.2, 5});
  const PartCost two = cost_of(solve_costs(scene, head), "relaxation of the materials");
  EXPECT_NEAR(two.bytes / one.bytes, 1.5, 0.1);
  EXPECT_NEAR(two.nanoseconds / one.nanoseconds, 1.5, 0.1);
}

TEST(SolveCosts, GrowWithTheProblem) {
  Scene scene;
  scene.load.emplace();
  scene.contact.emplace();
  const SolveSize twice{head.volume, 2 * head.nodes, 2 * head.points, 2 * head.pairs};
  EXPECT_NEAR(bytes(solve_costs(scene, twice)) / bytes(solve_costs(scene, head)), 2, 0.15);
  for (const PartCost& cost : solve_costs(scene, {})) {
    EXPECT_GE(cost.bytes, 0) << cost.part;
  }
}

}  // namespace brainshift::pipelines::solve_cost_test
