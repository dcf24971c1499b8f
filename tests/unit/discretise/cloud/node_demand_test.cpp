// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cloud/node_demand.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/unit/discretise/bodies.hpp"
#include "tests/unit/expect_parts.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::discretise::node_demand_test {

using test::expect_parts;
using test::refusal;

const Eigen::Vector3d centre(30, -210, 55);
constexpr double radius = 50;

NodeDemand demand_of(const DiscretiseOptions& options, const LabelMap* labels = nullptr) {
  static const Surface surface = test::ball(radius, centre, 4);
  static const Scanlines body(surface);
  return node_demand(surface, {}, body, labels, options);
}

double total(const NodeDemand& demand) {
  return static_cast<double>(demand.surface_nodes + demand.interior_nodes);
}

TEST(NodeDemand, OfASpacingIsAboutANodeASquareAndACubeOfIt) {
  const double area = 4 * std::numbers::pi * radius * radius, volume = area * radius / 3;
  for (const double spacing : {4.0, 8.0}) {
    const NodeDemand demand = demand_of({.spacing = spacing});
    EXPECT_EQ(demand.spacing, spacing);
    EXPECT_NEAR(static_cast<double>(demand.surface_nodes), area / (spacing * spacing),
                0.15 * area / (spacing * spacing));
    const double cubes = volume / (spacing * spacing * spacing);
    EXPECT_NEAR(total(demand), cubes + 0.5 * static_cast<double>(demand.surface_nodes), 0.2 * cubes);
  }
}

TEST(NodeDemand, OfANumberOfNodesIsThatNumberAndItsSpacingAsksForAsMany) {
  for (const std::size_t nodes : {100U, 3000U, 100000U}) {
    const NodeDemand demand = demand_of({.nodes = nodes});
    EXPECT_EQ(demand.surface_nodes + demand.interior_nodes, nodes);
    EXPECT_NEAR(total(demand_of({.spacing = demand.spacing})), static_cast<double>(nodes), 2.0);
  }
}

TEST(NodeDemand, IsTwelveThousandWhereNothingIsAsked) {
  EXPECT_EQ(total(demand_of({})), 12000);
  EXPECT_TRUE(demand_of({}).sizing.is_uniform());
}

TEST(NodeDemand, ARefinementTakesMoreNodesOrAWiderSpacing) {
  const Refinement finer{.centres = centre.transpose() + Eigen::RowVector3d(0, 0, radius), .radius = 20, .factor = 0.5};
  const NodeDemand plain = demand_of({.spacing = 6.0}), fine = demand_of({.spacing = 6.0, .craniotomy = finer});
  EXPECT_GT(fine.surface_nodes, 1.1 * static_cast<double>(plain.surface_nodes));
  EXPECT_GT(fine.interior_nodes, 1.1 * static_cast<double>(plain.interior_nodes));
  EXPECT_NEAR(fine.sizing.factor(centre + Eigen::Vector3d(0, 0, radius)), 0.5, 1e-12);
  const NodeDemand as_many = demand_of({.nodes = 3000, .craniotomy = finer});
  EXPECT_GT(as_many.spacing, 1.03 * demand_of({.nodes = 3000}).spacing);
  EXPECT_EQ(total(as_many), 3000);
}

TEST(NodeDemand, OfATumourFitsTheSpacingThatItLeadsTo) {
  const LabelMap labels = test::ball_labels(centre, 20, 52);
  const DiscretiseOptions by_number{.nodes = 5000, .tumour_factor = 0.5};
  const NodeDemand demand = demand_of(by_number, &labels);
  EXPECT_NEAR(total(demand_of({.spacing = demand.spacing, .tumour_factor = 0.5}, &labels)), 5000, 100);
}

TEST(NodeDemand, OfTooFewOrTooManyNodesIsRefusedWithTheSpacing) {
  expect_parts(refusal([] { demand_of({.spacing = 60.0}); }),
               {"a spacing of 60", "too coarse for this body", "at least 30 are needed", "ask for a finer spacing"});
  expect_parts(refusal([] { demand_of({.spacing = 0.1}); }),
               {"a spacing of 0.1", "million nodes, more than 20 million", "ask for a coarser spacing"});
  expect_parts(refusal([] { demand_of({.spacing = 1e-6}); }), {"more than 20 million"});
}

}  // namespace brainshift::discretise::node_demand_test
