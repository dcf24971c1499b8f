// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/warnings.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <string>

#include "tests/unit/expect_parts.hpp"
#include "tests/unit/pipelines/runner/expect_one.hpp"
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
  expect_one(of_points(opening(75)), {"15 mm off", "same frame"});
}

TEST(Warnings, TellOfPointsThatAreLostOrDoNotMove) {
  Points both(2 * opening(60).rows(), 3);
  both << opening(60), -opening(60);
  expect_one(of_points(both), {"50 %", "are lost", "one opening"});
  expect_one(of_points(opening(60), 0), {"displacements are 0"});
}

TEST(Warnings, TellOfPointsThatMoveOutOfTheHeadAsIfASignWereTurned) {
  const Points points = opening(60);
  const auto moved = [&](const Eigen::RowVector3d& u) {
    return warnings_of(solve::CraniotomyLoad{points, u.replicate(points.rows(), 1)}, ball(), prescribed_on_top());
  };
  expect_one(moved({1, 0, 4}), {"move out of the head, by 3.6 mm", "turn the signs"});
  EXPECT_TRUE(moved({1, 0, -4}).empty());
  EXPECT_TRUE(moved({4, 0, 1}).empty()) << "along the cortex";
  EXPECT_TRUE(moved({0, 0, 0.5}).empty()) << "hardly";
}

TEST(Warnings, TellOfPointsThatMoveOutOfTheHeadWhereMostDoNotMove) {
  const Points points = opening(60);
  solve::CraniotomyLoad load{points, Points::Zero(points.rows(), 3), {}};
  load.displacement.col(2).head(4).setConstant(2);
  const Warnings said = warnings_of(load, ball(), prescribed_on_top());
  expect_one(said, {"move out of the head"});
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
  expect_one(of_load(), {"mm apart, move by vectors that differ by", "paired as they belong"});
  load.sigma = Points::Constant(points.rows(), 3, 0.5);
  EXPECT_TRUE(of_load().empty()) << "the noise says who is wrong";
}

TEST(Warnings, TellOfDisplacementsInMetres) {
  const Points points = opening(60);
  const solve::CraniotomyLoad load{points, Eigen::RowVector3d(0, 0, -0.004).replicate(points.rows(), 1), {}};
  const Warnings said = warnings_of(load, ball(), prescribed_on_top());
  expect_one(said, {"by more than 0.004 mm", "in mm are expected"});
}

TEST(Warnings, TellOfTwoDisplacementsInOnePlaceThatContradictEachOther) {
  const Points points = opening(60);
  solve::CraniotomyLoad load{points, Points::Constant(points.rows(), 3, 2)};
  load.positions.row(1) = load.positions.row(0);
  const auto of_load = [&] { return warnings_of(load, ball(), prescribed_on_top()); };
  EXPECT_TRUE(of_load().empty()) << "measured twice alike";
  load.displacement.row(1) *= -1;
  expect_one(of_load(), {"two displacements", "differ by 6.9 mm"});
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
  expect_one(warnings_of({cortex, none}, ball(), conditions), {"count as places inside", "same frame"});
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
  expect_one(warnings_of_sigma(sigma), {"of 10 measured points 1 ", "in mm are expected"});
}

TEST(Warnings, AdviseRobustWeightsWhereTheyGoWithTheLoad) {
  const std::optional<solve::Outlier> wrong = solve::Outlier{{1, 2, 3}, 7};
  expect_one(warnings_of(wrong, true), {"near (1 2 3)", "take it out", "robust=\"yes\""});
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
  expect_one(of_points(line), {"10 places on one line"});
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
  expect_one(warnings_of(t1, labels, brain), {"33 %", "one patient"});
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
  expect_one(warnings, {"boundary of the labelled brain", "4 mm beside it", "one patient"});
}

TEST(Warnings, TellOfABodyThatNothingButItsLoadHolds) {
  solve::Model model;
  model.cloud = ball();
  const Points shift = Eigen::RowVector3d(0, 3, 4).replicate(model.cloud.positions.rows(), 1);
  expect_one(warnings_of(model, shift), {"nothing but the load", "more than 5 mm", "<contact/>"});
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
  expect_one(warnings_of(model, turned(5)), {"turned by 5 degrees", "without friction"});
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
  expect_one(warnings_of(solve::Model(), solution), {"1.5 mm", "more than half", "more nodes"});
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
  expect_one(warnings_of_rooms(model), {"tissue 2", "room=\"drained\""});
  model.materials[2].room = solve::Room::drained;
  EXPECT_TRUE(warnings_of_rooms(model).empty());
}

TEST(Warnings, TellOfAFieldThatFolds) {
  registration::RegisterMeasures measures;
  EXPECT_TRUE(warnings_of(measures).empty());
  measures.folded_voxels = 768;
  measures.field_jacobian_min = -0.16;
  expect_one(warnings_of(measures), {"768 voxels", "-0.16"});
}

TEST(Warnings, TellWhereNoNodesAreNear) {
  registration::RegisterMeasures measures;
  measures.brain_voxels = 1000000;
  measures.without_nodes = 8;
  EXPECT_TRUE(warnings_of(measures).empty()) << "a gap in another program's cloud";
  measures.without_nodes = 4000;
  const Warnings warnings = warnings_of(measures);
  expect_one(warnings, {"4000 voxels", "--wall"});
}

}  // namespace brainshift::pipelines::warnings_test
