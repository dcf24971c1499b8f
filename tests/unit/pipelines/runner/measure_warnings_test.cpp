// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/measure_warnings.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/pipelines/runner/expect_one.hpp"

namespace brainshift::pipelines::measure_warnings_test {

solve::SolveMeasures of_many_points() {
  solve::SolveMeasures measures;
  measures.nodes = 1000;
  measures.integration_points = 8000;
  return measures;
}

TEST(MeasureWarnings, TellOfPointsThatLieInNoTissueOfTheLabelMap) {
  solve::SolveMeasures measures = of_many_points();
  measures.outside_label = 400;
  EXPECT_TRUE(warnings_of(measures).empty());
  measures.outside_label = 4000;
  expect_one(warnings_of(measures), {"50 %", "material", "frame"});
}

TEST(MeasureWarnings, TellOfPointsThatAgreeFarBetterThanTheirNoise) {
  solve::SolveMeasures measures = of_many_points();
  measures.measured.emplace().weights.resize(2);
  for (const double fine : {0.5, 1.0, 3.0}) {
    measures.measured->noise_factor = fine;
    EXPECT_TRUE(warnings_of(measures).empty()) << fine;
  }
  measures.measured->noise_factor = 0.25;
  expect_one(warnings_of(measures), {"4 times better", "standard deviation"});
  measures.measured->weights.clear();
  EXPECT_TRUE(warnings_of(measures).empty()) << "whoever gives the weight says how closely the load is followed";
}

TEST(MeasureWarnings, TellOfFewPointsInAPressedBody) {
  solve::SolveMeasures measures;
  measures.nodes = 1000;
  measures.integration_points = 1250;
  measures.smallest_jacobian = 0.9;
  EXPECT_TRUE(warnings_of(measures).empty());
  measures.smallest_jacobian = 0.46;
  expect_one(warnings_of(measures), {"only 1.2 integration points a node", "to 0.46"});
  measures.integration_points = 2000;
  EXPECT_TRUE(warnings_of(measures).empty());
  measures.fewest_points = 0.43;
  expect_one(warnings_of(measures), {"about some nodes", "only 0.43 integration points a node"});
}

TEST(MeasureWarnings, TellOfFewerPointsThanNodes) {
  solve::SolveMeasures measures;
  measures.nodes = 343;
  measures.smallest_jacobian = 0.97;
  for (const std::size_t points : {224U, 342U}) {
    measures.integration_points = points;
    expect_one(warnings_of(measures), {"only " + std::to_string(points) + " integration points for 343"});
  }
  measures.region_nodes = 100;
  EXPECT_TRUE(warnings_of(measures).empty()) << "the points are those of the region";
  measures.region_nodes = 0;
  measures.integration_points = 343;
  EXPECT_TRUE(warnings_of(measures).empty());
}

TEST(MeasureWarnings, TellOfFewSpacingsAcrossAPatch) {
  solve::SolveMeasures measures = of_many_points();
  measures.thin = {{"the held patch", 3.2}};
  expect_one(warnings_of(measures), {"nothing says how far off", "the held patch (3.2)"});
  measures.estimated_error_95 = 0.3;
  expect_one(warnings_of(measures), {"farther off than is estimated", "the held patch (3.2)"});
}

/// A ventricle nearly always is: no alarm where the rest is estimated.
TEST(MeasureWarnings, OfATissueThatIsFewSpacingsAcrossAreNotesWhereNodesAreMany) {
  solve::SolveMeasures measures = of_many_points();
  measures.converged = true;
  measures.nodes = 400;
  measures.thin = {{.what = "tissue 2", .spacings = 2.7, .is_tissue = true}};
  measures.estimated_error_95 = 0.3;
  EXPECT_EQ(warnings_of(measures).size(), 1U);
  EXPECT_TRUE(notes_of(measures).empty());
  measures.nodes = 600;
  EXPECT_TRUE(warnings_of(measures).empty());
  expect_one(notes_of(measures), {"four", "tissue 2 (2.7)"});
}

TEST(MeasureWarnings, HaveANoteWhereNothingEstimatesTheError) {
  solve::SolveMeasures measures = of_many_points();
  measures.converged = true;
  expect_one(notes_of(measures), {"nothing estimates"});
  measures.estimated_error_95 = 0.3;
  EXPECT_TRUE(notes_of(measures).empty());
}

TEST(MeasureWarnings, TellOfVolumeUnderHighPressure) {
  solve::SolveMeasures measures = of_many_points();
  measures.pressed_share = 0.02;
  EXPECT_TRUE(warnings_of(measures).empty());
  measures.pressed_share = 0.41;
  expect_one(warnings_of(measures), {"41 % of a tissue's volume", "6 shear moduli", "change of volume"});
}

TEST(MeasureWarnings, TellOfACavityThatIsPressedFlat) {
  solve::SolveMeasures measures = of_many_points();
  measures.resection = solve::ResectionMeasures{.removed_volume = 2000, .wall_nodes = 50};
  EXPECT_TRUE(warnings_of(measures).empty()) << "it lies open";
  measures.resection->volume = 200;
  EXPECT_TRUE(warnings_of(measures).empty());
  measures.resection->volume = 26;
  expect_one(warnings_of(measures), {"1.3 % are left", "creased more finely than the nodes"});
}

TEST(MeasureWarnings, TellOfPartsThatFewNodesHardlyResolve) {
  solve::SolveMeasures measures;
  measures.nodes = 300;
  measures.integration_points = 800;
  measures.thin = {{"the moved patch", 2.13}, {"tissue 3", 1.5}};
  expect_one(warnings_of(measures), {"how far off", "the moved patch (2.1), tissue 3 (1.5)", "more nodes"});
}

}  // namespace brainshift::pipelines::measure_warnings_test
