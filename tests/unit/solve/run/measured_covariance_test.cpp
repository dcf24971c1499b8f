// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/measured_covariance.hpp"

#include <gtest/gtest.h>

#include "solve/run/measured.hpp"
#include "solve/run/measured_points.hpp"
#include "tests/unit/solve/measured_box.hpp"

namespace brainshift::solve::measured_covariance_test {

TEST(MeasuredCovariance, IsTheNoisesNearThePointsAndThePriorsFarOffAndGrowsWithBoth) {
  const Model model = with_weight(measured_box(0.5), 0.05);
  const SolveResult answer = solve(model, linear_options());
  MeasuredFit fit = *answer.measures.measured;
  fit.noise_factor = 1;
  const Points& u = answer.solution.displacement;
  const Eigen::MatrixXd covariance = measured_covariance(model, linear_options(), fit, u);
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
  const double times = measured_covariance(model, linear_options(), fit, u).norm() / covariance.norm();
  EXPECT_GE(times, 4);
  EXPECT_LT(times, 6) << "of larger errors the answer tells less of their size";
}

TEST(MeasuredCovariance, IsThatOfTheLandmarksAtANodeInside) {
  Model model = measured_box(0.5);
  Eigen::Index middle = 0;
  (model.cloud.positions.array() - model_side / 2).matrix().rowwise().norm().minCoeff(&middle);
  model.conditions.measured->asked = model.cloud.positions.row(middle);
  const SolveResult answer = solve(model, linear_options());
  const MeasuredFit& fit = *answer.measures.measured;
  const Eigen::RowVectorXd at_node =
      measured_covariance(model, linear_options(), fit, answer.solution.displacement).row(middle);
  EXPECT_LT((at_node - fit.covariance.row(0)).norm(), 1e-9 * at_node.norm());
}

TEST(MeasuredCovariance, OfALandmarkFarOutsideIsNoReasonToRefuse) {
  Model model = measured_box(0.5);
  model.conditions.measured->asked = Points::Constant(1, 3, 10 * model_side);
  EXPECT_TRUE(fit_measured(thinned_body(model, {}), model.conditions).covariance.allFinite());
}

/// A thinned body may have nodes so far from each other.
TEST(WithinSight, IsWhatLiesAboutASpacingFromANode) {
  const NodeCloud thinned{.positions = Points{{0, 0, 0}, {50, 0, 0}}, .spacing = {25, 25}, .on_surface = {0, 0}};
  const Points places{{25, 0, 0}, {0, 19, 0}, {0, 60, 0}};
  EXPECT_EQ(within_sight(places, thinned), (Points{{25, 0, 0}, {0, 19, 0}, {0, 0, 0}}));
}

}  // namespace brainshift::solve::measured_covariance_test
