// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/measured.hpp"

#include <gtest/gtest.h>

#include <string>

#include "solve/measured/inner_rows.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::measured_test {

using test::refusal;

/// A cube held below; its upper face is measured to sink in the middle, each node by itself, and a point inside to move
/// sideways.
Model measured_box(double sigma) {
  Model model = box_model(test::box_cells(6, model_side));
  std::vector<Eigen::Triplet<double>> share;
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const Eigen::RowVector3d x = model.cloud.positions.row(a);
    if (x[2] < 1e-9) {
      model.conditions.displacement.row(a).setZero();
    }
    if (x[2] > model_side - 1e-9 && (x.head<2>().array() - model_side / 2).matrix().norm() < 25) {
      model.conditions.displacement.row(a) << 0, 0, -4;
      share.emplace_back(static_cast<int>(a), static_cast<int>(share.size()), 1.0);
    }
  }
  Measurement& measured = model.conditions.measured.emplace();
  const auto points = static_cast<Eigen::Index>(share.size());
  measured.spread.resize(model.cloud.positions.rows(), points);
  measured.spread.setFromTriplets(share.begin(), share.end());
  measured.sigma = Points::Constant(points, 3, sigma);
  measured.cortex.resize(points, 3);
  measured.cortex_displacement.resize(points, 3);
  for (const auto& entry : share) {
    measured.cortex.row(entry.col()) = model.cloud.positions.row(entry.row());
    measured.cortex_displacement.row(entry.col()) = model.conditions.displacement.row(entry.row());
  }
  measured.inner = measured.inner_displacement = measured.inner_sigma = Points(0, 3);
  return model;
}

SolveOptions quick() {
  SolveOptions options;
  options.shape.basis = Basis::linear;
  options.tolerance = 0.002;
  return options;
}

TEST(SolveMeasured, BecomesTheExactImpositionAsTheNoiseVanishes) {
  Model model = measured_box(0.001);
  const SolveResult soft = solve(model, quick());
  model.conditions.measured.reset();
  const SolveResult exact = solve(model, quick());
  ASSERT_TRUE(soft.failure.empty()) << soft.failure;
  EXPECT_LE((soft.solution.displacement - exact.solution.displacement).rowwise().norm().maxCoeff(), 0.01);
}

TEST(SolveMeasured, RestsWhereVarianceTimesForceIsWhatIsLeftOfTheMisfit) {
  Model model = measured_box(1);
  model.conditions.measured->weight = 0.05;
  model.conditions.at_nodes_alone = true;  // where displacements are told
  const SolveResult result = solve(model, quick());
  ASSERT_TRUE(result.failure.empty()) << result.failure;
  double largest = 0;
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if (model.conditions.measured->spread.row(a).norm() > 0) {
      const Eigen::RowVector3d left = model.conditions.displacement.row(a) - result.solution.displacement.row(a);
      const Eigen::RowVector3d given = result.solution.reaction_force.row(a) / 0.05;  // N mm² / mJ
      EXPECT_LT((left - given).norm(), 0.03) << left << " and " << given;
      largest = std::max(largest, left.norm());
    }
  }
  EXPECT_GT(largest, 0.5);
  EXPECT_EQ(result.measures.measured->weight, 0.05);
}

TEST(SolveMeasured, IsDrawnByAPointInside) {
  Model model = measured_box(0.5);
  const Points place = Points::Constant(1, 3, model_side / 2);
  Measurement& measured = *model.conditions.measured;
  measured.inner = place;
  measured.inner_displacement = Points::Zero(1, 3);
  measured.inner_displacement(0, 0) = 3;
  measured.inner_sigma = Points::Constant(1, 3, 0.01);
  measured.asked = place;
  const SolveResult result = solve(model, quick());
  ASSERT_TRUE(result.failure.empty()) << result.failure;
  const ShapeFunctions shape(model.cloud.positions, model.cloud.spacing, result.solution.shape);
  const Points parameters = parameters_from_displacement(shape, model.cloud.positions, result.solution.displacement);
  const ShapeRows seen = inner_rows(shape, place);
  double mean = 0;
  for (std::size_t k = 0; k < seen[0].size(); ++k) {
    mean += seen[0].value[k] * parameters(seen[0].node[k], 0);
  }
  EXPECT_NEAR(mean, 3, 0.02);
  EXPECT_FALSE(result.measures.measured->weights.empty());
  ASSERT_EQ(result.measures.measured->covariance.rows(), 1);
  EXPECT_LT(std::sqrt(result.measures.measured->covariance(0, 0)), 0.1);
}

TEST(MeasuredCovariance, IsTheNoisesNearThePointsAndThePriorsFarOffAndGrowsWithBoth) {
  Model model = measured_box(0.5);
  MeasuredFit fit;
  fit.weight = 0.05;
  const Eigen::MatrixXd covariance = measured_covariance(model, quick(), fit);
  ASSERT_EQ(covariance.rows(), model.cloud.positions.rows());
  EXPECT_GE(covariance.leftCols(3).minCoeff(), 0);
  for (Eigen::Index a = 0; a < covariance.rows(); ++a) {
    const Eigen::RowVector3d x = model.cloud.positions.row(a);
    if (x[2] < 1e-9) {
      EXPECT_LT(covariance.row(a).norm(), 0.05) << "held";
    }
    if (model.conditions.measured->spread.row(a).norm() > 0) {
      EXPECT_LT(covariance.row(a).leftCols(3).maxCoeff(), 0.25) << "no worse than the point itself";
    }
  }
  fit.noise_factor = 2;
  EXPECT_LT((measured_covariance(model, quick(), fit) - 4 * covariance).norm(), 1e-9 * covariance.norm());
}

TEST(MeasuredCovariance, IsThatOfTheLandmarksAtANodeInside) {
  Model model = measured_box(0.5);
  Eigen::Index middle = 0;
  (model.cloud.positions.array() - model_side / 2).matrix().rowwise().norm().minCoeff(&middle);
  model.conditions.measured->asked = model.cloud.positions.row(middle);
  const MeasuredFit fit = fit_measured(model, quick());
  const Eigen::RowVectorXd at_node = measured_covariance(model, quick(), fit).row(middle);
  EXPECT_LT((at_node - fit.covariance.row(0)).norm(), 1e-9 * at_node.norm());
}

TEST(WeighedConditions, HoldAnOpeningThatMovesAlikeAndAreSolvedAsTheyAre) {
  Model model = measured_box(0.5);
  Measurement& measured = *model.conditions.measured;
  measured.inner = Points::Constant(1, 3, model_side / 2);
  measured.inner_displacement = Points::Zero(1, 3);
  measured.inner_sigma = Points::Constant(1, 3, 0.5);
  const MeasuredFit fit = fit_measured(model, quick());
  ASSERT_GT(fit.smooth.length, 0);
  const SolveResult whole = solve(model, quick());
  model.conditions = weighed_conditions(model, fit);
  const SolveResult again = solve(model, quick());
  ASSERT_TRUE(again.failure.empty()) << again.failure;
  EXPECT_LT((whole.solution.displacement - again.solution.displacement).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(WorstOutlier, IsThePointThatContradictsTheOthersAndNoneWhereAllAgree) {
  Model model = measured_box(0.5);
  EXPECT_FALSE(worst_outlier(model, quick()));
  Measurement& measured = *model.conditions.measured;
  const Eigen::Index wrong = measured.cortex.rows() / 2;
  measured.cortex_displacement.row(wrong) << 30, 0, -4;
  const std::optional<Outlier> found = worst_outlier(model, quick());
  ASSERT_TRUE(found);
  EXPECT_EQ(found->position, measured.cortex.row(wrong).transpose());
  EXPECT_GT(found->deviations, 5);
}

TEST(SolveMeasured, RefusesWhatNoiseDoesNotGoWith) {
  const Model model = measured_box(0.5);
  SolveOptions options = quick();
  options.dynamics = Dynamics::transient;
  EXPECT_NE(refusal([&] { solve(model, options); }).find("motion in time"), std::string::npos);
  options = quick();
  options.imposition = Imposition::simplified;
  EXPECT_NE(refusal([&] { solve(model, options); }).find("simplified"), std::string::npos);
  options = quick();
  options.region = 1;
  EXPECT_NE(refusal([&] { solve(model, options); }).find("a region"), std::string::npos);
}

}  // namespace brainshift::solve::measured_test
