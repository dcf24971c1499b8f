// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/measured.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <string>
#include <vector>

#include "solve/load/noisy_load.hpp"
#include "solve/measured/inner_rows.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/measured_box.hpp"

namespace brainshift::solve::measured_test {

using test::refusal;

TEST(SolveMeasured, BecomesTheExactImpositionAsTheNoiseVanishes) {
  Model model = measured_box(0.001);
  const SolveResult soft = solve(model, linear_options());
  model.conditions.measured.reset();
  const SolveResult exact = solve(model, linear_options());
  ASSERT_TRUE(soft.failure.empty()) << soft.failure;
  EXPECT_LE((soft.solution.displacement - exact.solution.displacement).rowwise().norm().maxCoeff(), 0.01);
}

TEST(SolveMeasured, RestsWhereVarianceTimesForceIsWhatIsLeftOfTheMisfit) {
  Model model = measured_box(1);
  model.conditions.measured->weight = 0.05;
  model.conditions.at_nodes_alone = true;  // where displacements are told
  const SolveResult result = solve(model, linear_options());
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

TEST(FitMeasured, IsTheSameToTheLastBitForAnyNumberOfThreads) {
  Model model = measured_box(0.5);
  model.conditions.measured->asked = Points::Constant(3, 3, model_side / 3);
  const int threads = omp_get_max_threads();
  std::vector<MeasuredFit> fits;
  for (const int count : {1, 2, 4}) {
    omp_set_num_threads(count);
    fits.push_back(fit_measured(thinned_body(model, {}), model.conditions));
  }
  omp_set_num_threads(threads);
  for (const MeasuredFit& fit : fits) {
    EXPECT_EQ(fit.noise_factor, fits[0].noise_factor);
    EXPECT_EQ(fit.smoothed, fits[0].smoothed);
    EXPECT_EQ(fit.covariance, fits[0].covariance);
    EXPECT_EQ(fit.weights.back().log_likelihood, fits[0].weights.back().log_likelihood);
  }
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
  const SolveResult result = solve(model, linear_options());
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

TEST(WeighedConditions, HoldAnOpeningThatMovesAlikeAndAreSolvedAsTheyAre) {
  Model model = measured_box(0.5);
  Measurement& measured = *model.conditions.measured;
  measured.inner = Points::Constant(1, 3, model_side / 2);
  measured.inner_displacement = Points::Zero(1, 3);
  measured.inner_sigma = Points::Constant(1, 3, 0.5);
  const MeasuredFit fit = fit_measured(thinned_body(model, {}), model.conditions);
  ASSERT_GT(fit.smooth.length, 0);
  const SolveResult whole = solve(model, linear_options());
  model.conditions = weighed_conditions(model.conditions, fit);
  const SolveResult again = solve(model, linear_options());
  ASSERT_TRUE(again.failure.empty()) << again.failure;
  EXPECT_LT((whole.solution.displacement - again.solution.displacement).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(WeighedConditions, ExtendThePointsOfASmoothMotionAsAnExactLoadIs) {
  const NodeCloud cloud = measured_box(1).cloud;
  CraniotomyLoad load{Points(12, 3), Points(12, 3), Points::Constant(12, 3, 1)};
  for (Eigen::Index p = 0; p < 12; ++p) {
    const auto angle = static_cast<double>(p);
    load.positions.row(p) << 0.5 * model_side + 2 * angle * std::cos(angle),
        0.5 * model_side + 2 * angle * std::sin(angle), model_side;
    load.displacement.row(p) << 2 * std::sin(7 * angle), 0, -4 + 2 * std::cos(5 * angle);  // noise, for the most part
  }
  const Conditions conditions = noisy_conditions(cloud, load);
  MeasuredFit fit;
  fit.smooth.length = 20;
  fit.smoothed = 0.1 * conditions.measured->cortex_displacement;
  fit.smoothed.col(2).array() -= 3;
  const Points exact = prescribed_on_surface_nodes(cloud, {conditions.measured->cortex, fit.smoothed, {}});
  const Points weighed = weighed_conditions(conditions, fit).displacement;
  ASSERT_TRUE((weighed.array().isNaN() == exact.array().isNaN()).all());
  EXPECT_TRUE((exact.array().isNaN() || weighed.array() == exact.array()).all());
}

TEST(SolveMeasured, RefusesWhatNoiseDoesNotGoWith) {
  const Model model = measured_box(0.5);
  SolveOptions options = linear_options();
  options.dynamics = Dynamics::transient;
  EXPECT_NE(refusal([&] { solve(model, options); }).find("motion in time"), std::string::npos);
  options = linear_options();
  options.imposition = Imposition::simplified;
  EXPECT_NE(refusal([&] { solve(model, options); }).find("simplified"), std::string::npos);
  options = linear_options();
  options.region = 1;
  EXPECT_NE(refusal([&] { solve(model, options); }).find("a region"), std::string::npos);
}

}  // namespace brainshift::solve::measured_test
