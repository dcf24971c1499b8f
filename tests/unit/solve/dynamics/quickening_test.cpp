// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/quickening.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/unit/solve/turned_cube.hpp"

namespace brainshift::solve::quickening_test {

/// One solve for all of it: tests run in processes of their own.
TEST(Turned, ComesToRestInHalfTheStepsWhereItsBoundSaysAndBalancesItsEnergies) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.1, Eigen::Vector3d(1, 2, 0).normalized()).toRotationMatrix();
  const SolveResult result = solve(turned_by_a_patch(turn), {});
  EXPECT_TRUE(result.measures.converged) << result.failure;
  EXPECT_LT(result.measures.steps, 2500);  // 3,720 without

  const double off =
      (result.solution.displacement - turn_of(result.solution.positions, turn)).rowwise().norm().maxCoeff();
  EXPECT_LE(off, 2 * result.measures.error_bound);

  double largest = 0;
  for (const HistoryRow& row : result.history) {
    largest = std::max(largest, std::abs(row.external_work));
    EXPECT_NEAR(row.external_work, row.strain_energy + row.kinetic_energy + row.dissipated_energy, 0.01 * largest)
        << row.step;
  }
}

}  // namespace brainshift::solve::quickening_test
