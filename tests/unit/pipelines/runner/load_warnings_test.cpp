// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/load_warnings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/unit/expect_parts.hpp"
#include "tests/unit/pipelines/runner/expect_one.hpp"
#include "tests/unit/pipelines/runner/loaded_ball.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::pipelines::load_warnings_test {

using brainshift::test::expect_parts;

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

TEST(LoadWarnings, TellOfAFieldThatIsZeroInALargePart) {
  Points field = Points::Constant(11, 3, std::nan(""));
  field.topRows(10).setConstant(0.5);
  field.topRows(2).setZero();
  EXPECT_TRUE(warnings_of_held("warp.nii.gz", field).empty());
  field.row(2).setZero();
  expect_one(warnings_of_held("warp.nii.gz", field), {"warp.nii.gz", "exactly 0 at 3 of 10 nodes", "held", "NaN"});
  field.topRows(10).setZero();
  EXPECT_TRUE(warnings_of_held("warp.nii.gz", field).empty()) << "nothing moves, which another warning tells";
}

TEST(LoadWarnings, TellOfPointsThatLieOffTheSurface) {
  EXPECT_TRUE(of_points(opening(60)).empty());
  EXPECT_TRUE(of_points(opening(63)).empty());
  expect_one(of_points(opening(75)), {"15 mm off", "same frame"});
}

TEST(LoadWarnings, TellOfPointsThatAreLostOrDoNotMove) {
  Points both(2 * opening(60).rows(), 3);
  both << opening(60), -opening(60);
  expect_one(of_points(both), {"50 %", "are lost", "one opening"});
  expect_one(of_points(opening(60), 0), {"displacements are 0"});
}

TEST(LoadWarnings, TellOfPointsThatMoveOutOfTheHeadAsIfASignWereTurned) {
  const Points points = opening(60);
  const auto moved = [&](const Eigen::RowVector3d& u) {
    return warnings_of(solve::CraniotomyLoad{points, u.replicate(points.rows(), 1)}, ball(), prescribed_on_top());
  };
  expect_one(moved({1, 0, 4}), {"move out of the head, by 3.6 mm", "turn the signs"});
  EXPECT_TRUE(moved({1, 0, -4}).empty());
  EXPECT_TRUE(moved({4, 0, 1}).empty()) << "along the cortex";
  EXPECT_TRUE(moved({0, 0, 0.5}).empty()) << "hardly";
}

TEST(LoadWarnings, TellOfPointsThatMoveOutOfTheHeadWhereMostDoNotMove) {
  const Points points = opening(60);
  solve::CraniotomyLoad load{points, Points::Zero(points.rows(), 3), {}};
  load.displacement.col(2).head(4).setConstant(2);
  const Warnings said = warnings_of(load, ball(), prescribed_on_top());
  expect_one(said, {"move out of the head"});
}

TEST(LoadWarnings, TellOfNeighboursThatWereTakenForEachOther) {
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

TEST(LoadWarnings, TellOfDisplacementsInMetres) {
  const Points points = opening(60);
  const solve::CraniotomyLoad load{points, Eigen::RowVector3d(0, 0, -0.004).replicate(points.rows(), 1), {}};
  const Warnings said = warnings_of(load, ball(), prescribed_on_top());
  expect_one(said, {"by more than 0.004 mm", "in mm are expected"});
}

TEST(LoadWarnings, TellOfTwoDisplacementsInOnePlaceThatContradictEachOther) {
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

TEST(LoadWarnings, OfPointsInsideTheBrainTellHowManyCountAsSuch) {
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

TEST(LoadWarnings, OfPointsInsideTheBrainTellThatTheyAreFew) {
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

TEST(LoadWarnings, OfPointsInsideTheBrainAloneTellOfNeighboursThatContradictEachOther) {
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

TEST(LoadWarnings, TellOfStandardDeviationsInMetres) {
  Points sigma = Points::Constant(10, 3, 0.3);
  EXPECT_TRUE(warnings_of_sigma(sigma).empty());
  EXPECT_TRUE(warnings_of_sigma(Points(0, 3)).empty());
  sigma.row(4) /= 1000;
  expect_one(warnings_of_sigma(sigma), {"of 10 measured points 1 ", "in mm are expected"});
}

TEST(LoadWarnings, AdviseRobustWeightsWhereTheyGoWithTheLoad) {
  const std::optional<solve::Outlier> wrong = solve::Outlier{{1, 2, 3}, 7};
  expect_one(warnings_of(wrong, true), {"near (1 2 3)", "take it out", "robust=\"yes\""});
  ASSERT_EQ(warnings_of(wrong, false).size(), 1U);
  EXPECT_EQ(warnings_of(wrong, false).front().find("robust"), std::string::npos);
}

TEST(LoadWarnings, TellOfPointsThatAreFewOrOnALine) {
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

}  // namespace brainshift::pipelines::load_warnings_test
