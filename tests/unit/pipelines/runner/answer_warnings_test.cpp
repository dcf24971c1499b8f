// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/answer_warnings.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "tests/unit/expect_parts.hpp"
#include "tests/unit/pipelines/runner/expect_one.hpp"
#include "tests/unit/pipelines/runner/loaded_ball.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::pipelines::answer_warnings_test {

using brainshift::test::expect_parts;

TEST(AnswerWarnings, TellOfABodyThatNothingButItsLoadHolds) {
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

TEST(AnswerWarnings, TellOfABrainThatTurnsInItsSkullWhichIsNoAnswerWhereNothingElseHoldsIt) {
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
  model.conditions = {};
  model.conditions.measured.emplace();
  EXPECT_EQ(turn_fault(model, turned(30)), "") << "as measured inside alone, where no node is prescribed";
}

TEST(AnswerWarnings, TellOfAnErrorThatIsLargeBesideTheAnswer) {
  Solution solution = turned(2);  // by 2 mm at most
  solution.estimated_error.assign(static_cast<std::size_t>(solution.positions.rows()), 0.5);
  EXPECT_TRUE(warnings_of(solve::Model(), solution).empty());
  solution.estimated_error.assign(solution.estimated_error.size(), 1.5);
  expect_one(warnings_of(solve::Model(), solution), {"1.5 mm", "more than half", "more nodes"});
}

TEST(AnswerWarnings, TellOfNodesBesideASeptumThatMoveFartherThanTheLoad) {
  solve::Model model;
  model.cloud = ball();
  model.conditions.displacement = prescribed_on_top();
  const Solution solution = turned(2);
  const double moved = solution.displacement.rowwise().norm().maxCoeff();
  double loaded = 0;
  for (auto u : model.conditions.displacement.rowwise()) {
    loaded = u.allFinite() ? std::max(loaded, u.norm()) : loaded;
  }
  ASSERT_GT(loaded, 0);
  model.conditions.displacement *= moved / loaded / 1.5;
  EXPECT_TRUE(warnings_of(model, solution).empty()) << "no septum";
  model.septum.emplace();
  expect_one(warnings_of(model, solution), {"beside the septum single nodes move by up to", "take more nodes"});
  model.gravity = {0, 0, -1};
  EXPECT_TRUE(warnings_of(model, solution).empty()) << "the load is not all that moves it";
  model.gravity.setZero();
  model.conditions.displacement *= 1.4;
  EXPECT_TRUE(warnings_of(model, solution).empty());
}

TEST(AnswerWarnings, TellOfFluidThatStandsAboveTheBrain) {
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

TEST(AnswerWarnings, TellOfFluidThatStandsBelowTheBrain) {
  solve::Model model;
  model.cloud = ball();
  const double lowest = model.cloud.positions.col(2).minCoeff();  // gravity pulls along -z, so that its level is -z
  model.fluid = solve::DrainedFluid{.gravity = {0, 0, -9.8}, .gravity_of_image = {0, 0, -9.8}, .level = -lowest};
  EXPECT_TRUE(warnings_of_levels(model).empty()) << "as drained=\"100\" has it";
  model.fluid->level = -lowest + 20;
  expect_one(warnings_of_levels(model), {"20 mm below the whole brain", "all of it has drained", "along gravity"});
}

TEST(AnswerWarnings, TellOfTissuesThatFloatWhereGravityHasTurned) {
  solve::Model model;
  model.cloud = ball();
  model.materials = {{1, {.youngs_modulus = 3000}}, {2, {.youngs_modulus = 10}}};
  const double top = model.cloud.positions.col(1).minCoeff();
  model.fluid = solve::DrainedFluid{.gravity = {0, 9.8, 0}, .gravity_of_image = {0, 0, -9.8}, .level = top};
  expect_one(warnings_of_levels(model), {"no tissue is denser than the fluid, 1007 kg/m3", "density=\"1040\""});
  model.materials.at(1).density = 1040;
  EXPECT_TRUE(warnings_of_levels(model).empty());
  model.materials.at(1).density = 1000;
  model.fluid->gravity_of_image = model.fluid->gravity;
  EXPECT_TRUE(warnings_of_levels(model).empty()) << "what floats stays where it is";
}

TEST(AnswerWarnings, TellOfATissueAsSoftAsFluidThatIsNoRoom) {
  solve::Model model;
  model.materials = {{1, {.youngs_modulus = 3000}}, {2, {.youngs_modulus = 10}}};
  EXPECT_TRUE(warnings_of_rooms(model).empty()) << "nothing drains";
  model.fluid.emplace();
  expect_one(warnings_of_rooms(model), {"tissue 2", "room=\"drained\""});
  model.materials[2].room = solve::Room::drained;
  EXPECT_TRUE(warnings_of_rooms(model).empty());
}

}  // namespace brainshift::pipelines::answer_warnings_test
