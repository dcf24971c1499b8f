// SPDX-License-Identifier: GPL-3.0-or-later

#include "solve/run/error_estimate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solve/cut/face_nodes.hpp"
#include "solve/output/field_difference.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::error_estimate_test {

constexpr double side = 60;

Solution resting(const NodeCloud& cloud) {
  Solution solution;
  solution.positions = cloud.positions;
  solution.spacing = cloud.spacing;
  solution.displacement = Points::Zero(cloud.positions.rows(), 3);
  return solution;
}

TEST(ErrorEstimate, IsAShareOfAnEvenDifference) {
  const NodeCloud cloud = test::irregular_box(5, side);
  const Solution fine = resting(cloud);
  const Points coarse = fine.displacement.rowwise() + Eigen::RowVector3d(0, 2, 0);
  for (const double error : estimated_error(fine, coarse, 2)) {
    EXPECT_NEAR(error, 0.8 * 2, 1e-12);
  }
  for (const double error : estimated_error(fine, coarse, 1.5)) {
    EXPECT_NEAR(error, 0.8 * 2 * (std::pow(2, 1.5) - 1) / (std::pow(1.5, 1.5) - 1), 1e-12);
  }
}

/// Where two fields cross, the nodes about tell that they lie apart.
TEST(ErrorEstimate, DoesNotVanishWhereTheFieldsCross) {
  const NodeCloud cloud = test::irregular_box(9, side);
  const Solution fine = resting(cloud);
  Points coarse = fine.displacement;
  coarse.col(0) = (cloud.positions.col(0).array() - side / 2) / (side / 2);  // 1 mm at the ends
  const std::vector<double> error = estimated_error(fine, coarse, 2);
  for (std::size_t a = 0; a < cloud.size(); ++a) {
    const double apart = std::abs(coarse(static_cast<Eigen::Index>(a), 0));
    EXPECT_GE(error[a], 0.1) << apart;
    EXPECT_LE(error[a], 0.8 * (apart + 0.5));
  }
}

TEST(ErrorEstimate, OfTheFacesOfASeptumIsThatOfTheNodesAbout) {
  const NodeCloud cloud = test::irregular_box(5, side);
  Solution fine = resting(cloud);
  const Eigen::Index nodes = cloud.positions.rows(), split = nodes / 2;
  fine.positions.conservativeResize(nodes + 1, 3);
  const double spacing = cloud.spacing[static_cast<std::size_t>(split)];
  fine.positions.row(nodes) = fine.positions.row(split);
  fine.positions(split, 2) += off_face * spacing;
  fine.positions(nodes, 2) -= off_face * spacing;
  fine.spacing.push_back(spacing);
  fine.displacement = Points::Zero(nodes + 1, 3);
  Points coarse = Points::Zero(nodes, 3);
  coarse.col(1).setConstant(2);
  coarse(split, 1) = 100;  // of the other face
  const std::vector<double> error = estimated_error(fine, coarse, 2);
  ASSERT_EQ(error.size(), static_cast<std::size_t>(nodes + 1));
  EXPECT_NEAR(*std::ranges::max_element(error), 0.8 * 2, 1e-12);
  EXPECT_NEAR(error.back(), 0.8 * 2, 1e-12);
}

TEST(ErrorEstimate, OfAFlapThatHasFacesAloneIsThatOfTheNextNodesBeyond) {
  Solution fine = resting({});
  fine.positions = Points(4, 3);
  fine.positions << 0, 0, off_face, 50, 0, 0, 60, 0, 0, 0, 0, -off_face;
  fine.spacing.assign(4, 1);
  fine.displacement = Points::Zero(4, 3);
  Points coarse = Points::Constant(3, 3, 0);
  coarse(0, 1) = 100;  // of the other face
  coarse.bottomRows(2).col(1).setConstant(2);
  const std::vector<double> error = estimated_error(fine, coarse, 2);
  EXPECT_NEAR(error.front(), 0.8 * 2, 1e-12);
  EXPECT_NEAR(error.back(), 0.8 * 2, 1e-12);
}

/// Held at its ends: no homogeneous state.
Model bonded(double stretch, int n) {
  Model model = uniaxial(stretch, n);
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if (model.cloud.positions(a, 2) < 1e-9 || model.cloud.positions(a, 2) > side - 1e-9) {
      model.conditions.displacement.row(a).head<2>().setZero();
    }
  }
  return model;
}

/// Of the coarse model's answer, against one of eight times the nodes.
void expect_honest(const SolveResult& result, const SolveResult& finer) {
  ASSERT_EQ(result.failure + finer.failure, "");
  ASSERT_EQ(result.solution.estimated_error.size(), result.solution.spacing.size());
  const double true_95 = field_difference(result.solution, finer.solution).percentile_95;
  testing::Test::RecordProperty("estimate",
                                std::to_string(*result.measures.estimated_error_95) + " of " + std::to_string(true_95));
  EXPECT_GE(*result.measures.estimated_error_95, 0.5 * true_95);
  EXPECT_LE(*result.measures.estimated_error_95, 5 * true_95);
}

TEST(ErrorEstimate, ComesWithEverySolutionAtRest) {
  const Model coarse = bonded(0.8, 6);
  SolveOptions options;
  options.start = Start::coarse;
  const SolveResult result = solve(coarse, options);
  expect_honest(result, solve(bonded(0.8, 11), options));

  options.start = Start::rest;
  options.snapshot_every = 50;
  const SolveResult from_rest = solve(coarse, options);
  ASSERT_EQ(from_rest.failure, "");
  EXPECT_NEAR(*from_rest.measures.estimated_error_95, *result.measures.estimated_error_95, 2 * options.tolerance);
  options.max_steps = 50;
  EXPECT_TRUE(solve(coarse, options).solution.estimated_error.empty()) << "it has not come to rest";
}

/// Half through, open, from the start or on the way.
TEST(ErrorEstimate, ComesWithACutBody) {
  Cut cut{.name = "cut", .vertices = Points(4, 3), .triangles = Triangles(2, 3), .time = {}};
  cut.vertices << -5, -5, 29, 32, -5, 29, 32, 65, 29, -5, 65, 29;
  cut.triangles << 0, 1, 2, 0, 2, 3;
  Model coarse = bonded(1.2, 6), fine = bonded(1.2, 11);
  coarse.cuts = fine.cuts = {cut};
  SolveOptions quick;
  quick.shape.basis = Basis::linear;
  const SolveResult finer = solve(fine, quick);
  expect_honest(solve(coarse, quick), finer);
  coarse.cuts[0].time = {0.1, 0.9, 0.9, 0.1};
  expect_honest(solve(coarse, quick), finer);
}

TEST(ErrorEstimate, ComesWithAMotionInTimeThatEndsOnItsWay) {
  Model coarse = bonded(1.3, 6), fine = bonded(1.3, 11);
  coarse.curve = fine.curve = LoadCurve({0, 0.05}, {0, 0.7}, LoadCurve::Join::smooth);
  const SolveOptions options = in_time(5);
  expect_honest(solve(coarse, options), solve(fine, options));
}

}  // namespace brainshift::solve::error_estimate_test
