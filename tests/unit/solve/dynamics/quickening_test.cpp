// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/quickening.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::quickening_test {

/// A cube that hangs from a small patch in the middle of a face, which is turned: the cube turns with it, unstrained.
Model turned_by_a_patch(const Eigen::Matrix3d& turn) {
  Model model = box_model(test::box_cells(8, model_side), 9);
  const Eigen::RowVector3d middle(model_side / 2, model_side / 2, 0);
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const Eigen::RowVector3d arm = model.cloud.positions.row(a) - middle;
    if (arm.norm() < 0.2 * model_side && arm.z() < 1e-9) {
      model.conditions.displacement.row(a) = arm * turn.transpose() - arm;
    }
  }
  return model;
}

/// One solve for all of it: tests run in processes of their own.
TEST(Turned, ComesToRestInHalfTheStepsWhereItsBoundSaysAndBalancesItsEnergies) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.1, Eigen::Vector3d(1, 2, 0).normalized()).toRotationMatrix();
  const SolveResult result = solve(turned_by_a_patch(turn), {});
  EXPECT_TRUE(result.measures.converged) << result.failure;
  EXPECT_LT(result.measures.steps, 2500);  // 3,720 without

  const Eigen::RowVector3d middle(model_side / 2, model_side / 2, 0);
  const Points arms = result.solution.positions.rowwise() - middle;
  const double off = (result.solution.displacement - (arms * turn.transpose() - arms)).rowwise().norm().maxCoeff();
  EXPECT_LE(off, 2 * result.measures.error_bound);

  double largest = 0;
  for (const HistoryRow& row : result.history) {
    largest = std::max(largest, std::abs(row.external_work));
    EXPECT_NEAR(row.external_work, row.strain_energy + row.kinetic_energy + row.dissipated_energy, 0.01 * largest)
        << row.step;
  }
}

}  // namespace brainshift::solve::quickening_test
