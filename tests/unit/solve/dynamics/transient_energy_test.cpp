// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/transient.hpp"

#include <gtest/gtest.h>

#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::transient_energy_test {

/// Largest |work − strain − kinetic − dissipated energy| on the way, of the largest work.
double energy_error(const SolveResult& result) {
  double worst = 0, largest = 0;
  for (const HistoryRow& row : result.history) {
    largest = std::max(largest, row.external_work);
    worst =
        std::max(worst, std::abs(row.external_work - row.strain_energy - row.kinetic_energy - row.dissipated_energy));
  }
  return worst / largest;
}

TEST(Transient, WorkIsStrainAndKineticAndDissipatedEnergy) {
  for (const double damping : {0.0, 10.0}) {
    const SolveResult result = solve(stretched(1.2, 0.15, 0.5), in_time(damping));
    ASSERT_TRUE(result.measures.converged) << result.failure;
    const HistoryRow& last = result.history.back();
    EXPECT_GT(last.strain_energy, 0.3 * last.external_work);
    EXPECT_GE(last.dissipated_energy, damping > 0 ? 0.05 * last.external_work : 0);
    EXPECT_LE(last.dissipated_energy, damping > 0 ? last.external_work : 0);
    RecordProperty(damping > 0 ? "damped" : "undamped", std::to_string(energy_error(result)));
    EXPECT_LE(energy_error(result), 1e-3) << damping;
  }
}

TEST(Transient, WorkOfForcesIsStrainAndKineticAndDissipatedEnergy) {
  Model model = stretched(1, 0.15, 0.5);
  model.gravity = {0, 0, -5};
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if (model.cloud.positions(a, 2) > model_side - 1e-9) {
      model.conditions.displacement(a, 2) = std::nan("");
    }
  }
  for (const double damping : {0.0, 10.0}) {
    const SolveResult result = solve(model, in_time(damping));
    ASSERT_TRUE(result.measures.converged) << result.failure;
    RecordProperty(damping > 0 ? "damped" : "undamped", std::to_string(energy_error(result)));
    EXPECT_LE(energy_error(result), 1e-3) << damping;
  }
}

TEST(Transient, StepFollowsABodyThatStiffens) {
  const Model model = stretched(0.4, 0.3, 0);
  const SolveResult result = solve(model, in_time());
  ASSERT_TRUE(result.measures.converged) << result.failure;
  const double steps_at_rest = 0.3 / (0.9 * result.measures.critical_step);
  EXPECT_GE(result.measures.steps, 1.05 * steps_at_rest);
  EXPECT_LE(energy_error(result), 1e-3);

  SolveOptions fine = in_time();
  fine.time_step = result.measures.critical_step / 8;
  const Points exact = solve(model, fine).solution.displacement;
  EXPECT_LE((result.solution.displacement - exact).norm(), 1e-3 * exact.norm());

  SolveOptions given = in_time();
  given.time_step = 0.99 * result.measures.critical_step;
  const SolveResult failed = solve(model, given);
  EXPECT_FALSE(failed.measures.converged);
  EXPECT_NE(failed.failure.find("has become so stiff"), std::string::npos) << failed.failure;
  EXPECT_GT(failed.measures.largest_displacement, 0);  // keeps what it has
}

}  // namespace brainshift::solve::transient_energy_test
