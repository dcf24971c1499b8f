// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/warnings.hpp"

#include "pipelines/runner/measure_warnings.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <string>

#include "tests/unit/expect_parts.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::pipelines::warnings_test {

using brainshift::test::expect_parts;

NodeCloud ball() {
  NodeCloud cloud;
  cloud.positions = brainshift::test::sphere({0, 0, 0}, 60, 4).vertices;
  const auto nodes = static_cast<std::size_t>(cloud.positions.rows());
  cloud.spacing.assign(nodes, 4);
  cloud.on_surface.assign(nodes, 1);
  return cloud;
}

/// Of the nodes under an opening.
Points prescribed_on_top() {
  const NodeCloud cloud = ball();
  Points prescribed = Points::Constant(cloud.positions.rows(), 3, std::numeric_limits<double>::quiet_NaN());
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    if (cloud.positions(a, 2) > 45) {
      prescribed.row(a).setConstant(1);
    }
  }
  return prescribed;
}

Warnings of_points(const Points& points, double moved = 1) {
  return warnings_of(solve::CraniotomyLoad{points, Points::Constant(points.rows(), 3, moved)}, ball(),
                     prescribed_on_top());
}

Points opening(double radius) {
  const Points all = brainshift::test::sphere({0, 0, 0}, radius, 3).vertices;
  Points points(0, 3);
  for (const auto& place : all.rowwise()) {
    if (place[2] > 0.8 * radius) {
      points.conservativeResize(points.rows() + 1, 3);
      points.bottomRows<1>() = place;
    }
  }
  return points;
}

TEST(Warnings, TellOfPointsThatLieOffTheSurface) {
  EXPECT_TRUE(of_points(opening(60)).empty());
  EXPECT_TRUE(of_points(opening(63)).empty());
  ASSERT_EQ(of_points(opening(75)).size(), 1U);
  expect_parts(of_points(opening(75)).front(), {"15 mm off", "same frame"});
}

TEST(Warnings, TellOfPointsThatAreLostOrDoNotMove) {
  Points both(2 * opening(60).rows(), 3);
  both << opening(60), -opening(60);
  ASSERT_EQ(of_points(both).size(), 1U);
  expect_parts(of_points(both).front(), {"50 %", "are lost", "one opening"});
  ASSERT_EQ(of_points(opening(60), 0).size(), 1U);
  expect_parts(of_points(opening(60), 0).front(), {"displacements are 0"});
}

TEST(Warnings, TellOfPointsThatMoveOutOfTheHeadAsIfASignWereTurned) {
  const Points points = opening(60);
  const auto moved = [&](const Eigen::RowVector3d& u) {
    return warnings_of(solve::CraniotomyLoad{points, u.replicate(points.rows(), 1)}, ball(), prescribed_on_top());
  };
  ASSERT_EQ(moved({1, 0, 4}).size(), 1U);
  expect_parts(moved({1, 0, 4}).front(), {"move out of the head, by 3.6 mm", "turn the signs"});
  EXPECT_TRUE(moved({1, 0, -4}).empty());
  EXPECT_TRUE(moved({4, 0, 1}).empty()) << "along the cortex";
  EXPECT_TRUE(moved({0, 0, 0.5}).empty()) << "hardly";
}

TEST(Warnings, TellOfPointsThatMoveOutOfTheHeadWhereMostDoNotMove) {
  const Points points = opening(60);
  solve::CraniotomyLoad load{points, Points::Zero(points.rows(), 3), {}};
  load.displacement.col(2).head(4).setConstant(2);
  const Warnings said = warnings_of(load, ball(), prescribed_on_top());
  ASSERT_EQ(said.size(), 1U);
  expect_parts(said.front(), {"move out of the head"});
}

TEST(Warnings, TellOfNeighboursThatWereTakenForEachOther) {
  const Points points = opening(60);
  solve::CraniotomyLoad load{points, Eigen::RowVector3d(0, 0, -3).replicate(points.rows(), 1), {}};
  const auto of_load = [&] { return warnings_of(load, ball(), prescribed_on_top()); };
  EXPECT_TRUE(of_load().empty());
  Eigen::Index other = 0;
  Eigen::VectorXd apart = (points.rowwise() - points.row(0)).rowwise().norm();
  apart[0] = 1e9;
  const double near = apart.minCoeff(&other);
  const Eigen::RowVector3d between = points.row(other) - points.row(0);
  load.displacement.row(0) += between * std::max(1.0, 4 / near);
  load.displacement.row(other) -= between * std::max(1.0, 4 / near);
  ASSERT_EQ(of_load().size(), 1U);
  expect_parts(of_load().front(), {"mm apart, move by vectors that differ by", "paired as they belong"});
  load.sigma = Points::Constant(points.rows(), 3, 0.5);
  EXPECT_TRUE(of_load().empty()) << "the noise says who is wrong";
}

TEST(Warnings, TellOfDisplacementsInMetres) {
  const Points points = opening(60);
  const solve::CraniotomyLoad load{points, Eigen::RowVector3d(0, 0, -0.004).replicate(points.rows(), 1), {}};
  const Warnings said = warnings_of(load, ball(), prescribed_on_top());
  ASSERT_EQ(said.size(), 1U);
  expect_parts(said.front(), {"by more than 0.004 mm", "in mm are expected"});
}

TEST(Warnings, TellOfTwoDisplacementsInOnePlaceThatContradictEachOther) {
  const Points points = opening(60);
  solve::CraniotomyLoad load{points, Points::Constant(points.rows(), 3, 2)};
  load.positions.row(1) = load.positions.row(0);
  const auto of_load = [&] { return warnings_of(load, ball(), prescribed_on_top()); };
  EXPECT_TRUE(of_load().empty()) << "measured twice alike";
  load.displacement.row(1) *= -1;
  ASSERT_EQ(of_load().size(), 1U);
  expect_parts(of_load().front(), {"two displacements", "differ by 6.9 mm"});
  load.sigma = Points::Constant(points.rows(), 3, 0.5);
  EXPECT_TRUE(of_load().empty()) << "told as points of a noisy load";
}

TEST(Warnings, OfPointsInsideTheBrainTellHowManyCountAsSuch) {
  const Points cortex = opening(60), none = Points::Constant(cortex.rows(), 3, 1);
  solve::Conditions conditions{.displacement = prescribed_on_top()};
  solve::Measurement& measured = conditions.measured.emplace();
  measured.cortex = cortex;
  measured.cortex_displacement = none;
  measured.inner = Points::Zero(1, 3);
  EXPECT_TRUE(warnings_of({cortex, none}, ball(), conditions).empty());
  measured.inner = opening(40).replicate(3, 1);
  ASSERT_EQ(warnings_of({cortex, none}, ball(), conditions).size(), 1U);
  expect_parts(warnings_of({cortex, none}, ball(), conditions).front(), {"count as places inside", "same frame"});
}

TEST(Warnings, OfPointsInsideTheBrainTellThatTheyAreFew) {
  solve::Conditions conditions{.displacement = prescribed_on_top()};
  solve::Measurement& measured = conditions.measured.emplace();
  const Points places = opening(40).topRows(3);
  measured.inner = places.replicate(6, 1);
  const Warnings said = warnings_of({measured.inner, measured.inner}, ball(), conditions);
  ASSERT_FALSE(said.empty());
  EXPECT_TRUE(std::ranges::any_of(said, [](const std::string& text) { return text.find("at 3 places; how") == 21; }))
      << said.front();
  measured.inner = opening(40);
  for (const std::string& text : warnings_of({measured.inner, measured.inner}, ball(), conditions)) {
    EXPECT_EQ(text.find("places; how"), std::string::npos) << text;
  }
}

TEST(Warnings, OfPointsInsideTheBrainAloneTellOfNeighboursThatContradictEachOther) {
  solve::Conditions conditions{.displacement = prescribed_on_top()};
  solve::Measurement& measured = conditions.measured.emplace();
  measured.inner = opening(40);
  Points moved = Points::Constant(measured.inner.rows(), 3, 0.3);
  const auto told = [&] {
    const Warnings said = warnings_of({measured.inner, moved}, ball(), conditions);
    return std::ranges::any_of(said, [](const std::string& text) { return text.find("paired as they belong") < 500; });
  };
  EXPECT_FALSE(told());
  moved.row(5) = Eigen::RowVector3d(20, -20, 10);
  EXPECT_TRUE(told());
}

TEST(Warnings, TellOfStandardDeviationsInMetres) {
  Points sigma = Points::Constant(10, 3, 0.3);
  EXPECT_TRUE(warnings_of_sigma(sigma).empty());
  EXPECT_TRUE(warnings_of_sigma(Points(0, 3)).empty());
  sigma.row(4) /= 1000;
  ASSERT_EQ(warnings_of_sigma(sigma).size(), 1U);
  expect_parts(warnings_of_sigma(sigma).front(), {"of 10 measured points 1 ", "in mm are expected"});
}

TEST(Warnings, AdviseRobustWeightsWhereTheyGoWithTheLoad) {
  const std::optional<solve::Outlier> wrong = solve::Outlier{{1, 2, 3}, 7};
  ASSERT_EQ(warnings_of(wrong, true).size(), 1U);
  expect_parts(warnings_of(wrong, true).front(), {"near (1 2 3)", "take it out", "robust=\"yes\""});
  ASSERT_EQ(warnings_of(wrong, false).size(), 1U);
  EXPECT_EQ(warnings_of(wrong, false).front().find("robust"), std::string::npos);
}

TEST(Warnings, TellOfPointsThatAreFewOrOnALine) {
  const Points few = opening(60).topRows(3);
  ASSERT_EQ(of_points(few).size(), 1U);
  const auto loaded = (prescribed_on_top().col(0).array() == 1).count();
  expect_parts(of_points(few).front(), {"at 3 places", std::to_string(loaded) + " nodes"});
  EXPECT_EQ(of_points(few.replicate(20, 1)), of_points(few));
  Points line(10, 3);
  for (int i = 0; i < 10; ++i) {
    line.row(i) << i - 5, 0, 59.5;
  }
  ASSERT_EQ(of_points(line).size(), 1U);
  expect_parts(of_points(line).front(), {"10 places on one line"});
}

TEST(Warnings, TellOfLabelsWhereTheT1IsBlack) {
  LabelMap labels;
  labels.geometry.size = {10, 1, 1};
  labels.voxels = {0, 1, 1, 1, 1, 2, 2, 2, 2, 2};
  ScalarImage t1{labels.geometry, std::vector<float>(10, 5.0F)};
  t1.voxels[0] = 0;
  const std::vector<std::uint16_t> brain = {1, 2};
  EXPECT_TRUE(warnings_of(t1, labels, brain).empty());
  std::fill_n(t1.voxels.begin() + 1, 3, 0.0F);
  ASSERT_EQ(warnings_of(t1, labels, brain).size(), 1U);
  expect_parts(warnings_of(t1, labels, brain).front(), {"33 %", "one patient"});
}

TEST(Warnings, TellOfLabelsWhoseBoundaryIsNoneInTheT1) {
  const auto bright = [](const Eigen::Vector3d& middle) {
    const ImageGeometry grid{.size = {60, 60, 60}};
    ScalarImage image{grid, std::vector<float>(grid.voxel_count())};
    LabelMap labels{grid, std::vector<std::uint16_t>(grid.voxel_count())};
    for (int k = 0; k < 60; ++k) {
      for (int j = 0; j < 60; ++j) {
        for (int i = 0; i < 60; ++i) {
          const bool inside = (Eigen::Vector3d(i, j, k) - middle).norm() < 18;
          labels.at(i, j, k) = inside ? 1 : 0;
          image.at(i, j, k) = inside ? 100.0F : 50.0F + static_cast<float>(i % 2);
        }
      }
    }
    return std::pair(image, labels);
  };
  const auto [t1, labels] = bright({30, 30, 30});
  const std::vector<std::uint16_t> brain = {1};
  EXPECT_TRUE(warnings_of(t1, labels, brain).empty());
  const auto warnings = warnings_of(t1, bright({38, 36, 30}).second, brain);
  ASSERT_EQ(warnings.size(), 1U);
  expect_parts(warnings.front(), {"boundary of the labelled brain", "4 mm beside it", "one patient"});
}

TEST(Warnings, TellOfABodyThatNothingButItsLoadHolds) {
  solve::Model model;
  model.cloud = ball();
  const Points shift = Eigen::RowVector3d(0, 3, 4).replicate(model.cloud.positions.rows(), 1);
  ASSERT_EQ(warnings_of(model, shift).size(), 1U);
  expect_parts(warnings_of(model, shift).front(), {"nothing but the load", "more than 5 mm", "<contact/>"});
  model.conditions.displacement = shift;
  EXPECT_TRUE(warnings_of(model, shift).empty()) << "a load all round holds it";
  model.conditions.displacement.bottomRows(2 * shift.rows() / 3).setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(warnings_of(model, shift).size(), 1U);
  model.skull = brainshift::test::sphere({0, 0, 0}, 60, 2);
  EXPECT_TRUE(warnings_of(model, shift).empty());
}

/// The ball, turned about z.
Solution turned(double degrees) {
  Solution solution;
  solution.positions = ball().positions;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(degrees * M_PI / 180, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  solution.displacement = solution.positions * turn.transpose() - solution.positions;
  return solution;
}

TEST(Warnings, TellOfABrainThatTurnsInItsSkullWhichIsNoAnswerWhereNothingElseHoldsIt) {
  solve::Model model;
  model.cloud = ball();
  EXPECT_TRUE(warnings_of(model, turned(30)).empty()) << "no skull";
  model.skull = brainshift::test::sphere({0, 0, 0}, 60, 2);
  EXPECT_TRUE(warnings_of(model, turned(2)).empty());
  ASSERT_EQ(warnings_of(model, turned(5)).size(), 1U);
  expect_parts(warnings_of(model, turned(5)).front(), {"turned by 5 degrees", "without friction"});
  EXPECT_EQ(turn_fault(model, turned(5)), "");
  expect_parts(turn_fault(model, turned(30)), {"turned by 30 degrees", "give a measured load"});
  model.conditions.displacement = prescribed_on_top();
  EXPECT_EQ(turn_fault(model, turned(30)), "") << "as measured";
}

TEST(Warnings, TellOfAnErrorThatIsLargeBesideTheAnswer) {
  Solution solution = turned(2);  // by 2 mm at most
  solution.estimated_error.assign(static_cast<std::size_t>(solution.positions.rows()), 0.5);
  EXPECT_TRUE(warnings_of(solve::Model(), solution).empty());
  solution.estimated_error.assign(solution.estimated_error.size(), 1.5);
  ASSERT_EQ(warnings_of(solve::Model(), solution).size(), 1U);
  expect_parts(warnings_of(solve::Model(), solution).front(), {"1.5 mm", "more than half", "more nodes"});
}

TEST(Warnings, TellOfFluidThatStandsAboveTheBrain) {
  solve::Model model;
  model.cloud = ball();
  EXPECT_TRUE(warnings_of_levels(model).empty());
  const double top = model.cloud.positions.col(1).minCoeff();
  model.fluid = solve::DrainedFluid{.gravity = {0, 9.8, 0}, .gravity_of_image = {0, 9.8, 0}, .level = top + 5};
  model.resection = solve::Resection{.labels = {}, .fluid_level = top - 10};
  EXPECT_TRUE(warnings_of_levels(model).empty());
  model.fluid->level = top - 30;
  model.resection->fluid_level = top - 60;
  const Warnings both = warnings_of_levels(model);
  ASSERT_EQ(both.size(), 2U);
  expect_parts(both[0], {"30 mm above the whole brain", "none has drained"});
  expect_parts(both[1], {"60 mm above the whole brain", "in the cavity"});
}

TEST(Warnings, TellOfATissueAsSoftAsFluidThatIsNoRoom) {
  solve::Model model;
  model.materials = {{1, {.youngs_modulus = 3000}}, {2, {.youngs_modulus = 10}}};
  EXPECT_TRUE(warnings_of_rooms(model).empty()) << "nothing drains";
  model.fluid.emplace();
  ASSERT_EQ(warnings_of_rooms(model).size(), 1U);
  expect_parts(warnings_of_rooms(model).front(), {"tissue 2", "room=\"drained\""});
  model.materials[2].room = solve::Room::drained;
  EXPECT_TRUE(warnings_of_rooms(model).empty());
}

solve::SolveMeasures of_many_points() {
  solve::SolveMeasures measures;
  measures.nodes = 1000;
  measures.integration_points = 8000;
  return measures;
}

TEST(Warnings, TellOfPointsThatLieInNoTissueOfTheLabelMap) {
  solve::SolveMeasures measures = of_many_points();
  measures.outside_label = 400;
  EXPECT_TRUE(warnings_of(measures).empty());
  measures.outside_label = 4000;
  ASSERT_EQ(warnings_of(measures).size(), 1U);
  expect_parts(warnings_of(measures).front(), {"50 %", "material", "frame"});
}

TEST(Warnings, TellOfPointsThatAgreeFarBetterThanTheirNoise) {
  solve::SolveMeasures measures = of_many_points();
  measures.measured.emplace();
  for (const double fine : {0.5, 1.0, 3.0}) {
    measures.measured->noise_factor = fine;
    EXPECT_TRUE(warnings_of(measures).empty()) << fine;
  }
  measures.measured->noise_factor = 0.25;
  ASSERT_EQ(warnings_of(measures).size(), 1U);
  expect_parts(warnings_of(measures).front(), {"4 times better", "standard deviation"});
}

TEST(Warnings, TellOfFewPointsInAPressedBody) {
  solve::SolveMeasures measures;
  measures.nodes = 1000;
  measures.integration_points = 1250;
  measures.smallest_jacobian = 0.9;
  EXPECT_TRUE(warnings_of(measures).empty());
  measures.smallest_jacobian = 0.46;
  ASSERT_EQ(warnings_of(measures).size(), 1U);
  expect_parts(warnings_of(measures).front(), {"only 1.2 integration points a node", "to 0.46"});
  measures.integration_points = 2000;
  EXPECT_TRUE(warnings_of(measures).empty());
  measures.fewest_points = 0.43;
  ASSERT_EQ(warnings_of(measures).size(), 1U);
  expect_parts(warnings_of(measures).front(), {"about some nodes", "only 0.43 integration points a node"});
}

TEST(Warnings, TellOfFewerPointsThanNodes) {
  solve::SolveMeasures measures;
  measures.nodes = 343;
  measures.smallest_jacobian = 0.97;
  for (const std::size_t points : {224U, 342U}) {
    measures.integration_points = points;
    ASSERT_EQ(warnings_of(measures).size(), 1U) << points;
    expect_parts(warnings_of(measures).front(), {"only " + std::to_string(points) + " integration points for 343"});
  }
  measures.region_nodes = 100;
  EXPECT_TRUE(warnings_of(measures).empty()) << "the points are those of the region";
  measures.region_nodes = 0;
  measures.integration_points = 343;
  EXPECT_TRUE(warnings_of(measures).empty());
}

TEST(Warnings, TellOfFewSpacingsAcrossAPatch) {
  solve::SolveMeasures measures = of_many_points();
  measures.thin = {{"the held patch", 3.2}};
  ASSERT_EQ(warnings_of(measures).size(), 1U);
  expect_parts(warnings_of(measures).front(), {"nothing says how far off", "the held patch (3.2)"});
  measures.estimated_error_95 = 0.3;
  ASSERT_EQ(warnings_of(measures).size(), 1U);
  expect_parts(warnings_of(measures).front(), {"farther off than is estimated", "the held patch (3.2)"});
}

/// A ventricle nearly always is: no alarm where the rest is estimated.
TEST(Warnings, OfATissueThatIsFewSpacingsAcrossAreNotesWhereNodesAreMany) {
  solve::SolveMeasures measures = of_many_points();
  measures.converged = true;
  measures.nodes = 400;
  measures.thin = {{.what = "tissue 2", .spacings = 2.7, .is_tissue = true}};
  measures.estimated_error_95 = 0.3;
  EXPECT_EQ(warnings_of(measures).size(), 1U);
  EXPECT_TRUE(notes_of(measures).empty());
  measures.nodes = 600;
  EXPECT_TRUE(warnings_of(measures).empty());
  ASSERT_EQ(notes_of(measures).size(), 1U);
  expect_parts(notes_of(measures).front(), {"four", "tissue 2 (2.7)"});
}

TEST(Warnings, HaveANoteWhereNothingEstimatesTheError) {
  solve::SolveMeasures measures = of_many_points();
  measures.converged = true;
  ASSERT_EQ(notes_of(measures).size(), 1U);
  expect_parts(notes_of(measures).front(), {"nothing estimates"});
  measures.estimated_error_95 = 0.3;
  EXPECT_TRUE(notes_of(measures).empty());
}

TEST(Warnings, TellOfVolumeUnderHighPressure) {
  solve::SolveMeasures measures = of_many_points();
  measures.pressed_share = 0.02;
  EXPECT_TRUE(warnings_of(measures).empty());
  measures.pressed_share = 0.41;
  ASSERT_EQ(warnings_of(measures).size(), 1U);
  expect_parts(warnings_of(measures).front(), {"41 % of a tissue's volume", "6 shear moduli", "change of volume"});
}

TEST(Warnings, TellOfACavityThatIsPressedFlat) {
  solve::SolveMeasures measures = of_many_points();
  measures.resection = solve::ResectionMeasures{.removed_volume = 2000, .wall_nodes = 50};
  EXPECT_TRUE(warnings_of(measures).empty()) << "it lies open";
  measures.resection->volume = 200;
  EXPECT_TRUE(warnings_of(measures).empty());
  measures.resection->volume = 26;
  ASSERT_EQ(warnings_of(measures).size(), 1U);
  expect_parts(warnings_of(measures).front(), {"1.3 % are left", "creased more finely than the nodes"});
}

TEST(Warnings, TellOfPartsThatFewNodesHardlyResolve) {
  solve::SolveMeasures measures;
  measures.nodes = 300;
  measures.integration_points = 800;
  measures.thin = {{"the moved patch", 2.13}, {"tissue 3", 1.5}};
  ASSERT_EQ(warnings_of(measures).size(), 1U);
  expect_parts(warnings_of(measures).front(), {"how far off", "the moved patch (2.1), tissue 3 (1.5)", "more nodes"});
}

TEST(Warnings, TellOfAFieldThatFolds) {
  registration::RegisterMeasures measures;
  EXPECT_TRUE(warnings_of(measures).empty());
  measures.folded_voxels = 768;
  measures.field_jacobian_min = -0.16;
  ASSERT_EQ(warnings_of(measures).size(), 1U);
  expect_parts(warnings_of(measures).front(), {"768 voxels", "-0.16"});
}

TEST(Warnings, TellWhereNoNodesAreNear) {
  registration::RegisterMeasures measures;
  measures.brain_voxels = 1000000;
  measures.without_nodes = 8;
  EXPECT_TRUE(warnings_of(measures).empty()) << "a gap in another program's cloud";
  measures.without_nodes = 4000;
  const Warnings warnings = warnings_of(measures);
  ASSERT_EQ(warnings.size(), 1U);
  expect_parts(warnings.front(), {"4000 voxels", "--wall"});
}

}  // namespace brainshift::pipelines::warnings_test
