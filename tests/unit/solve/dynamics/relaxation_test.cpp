// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/relaxation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "solve/material/named_materials.hpp"
#include "tests/unit/solve/models.hpp"
#include "tests/unit/solve/specimen.hpp"

namespace brainshift::solve::relaxation_test {

constexpr double side = model_side;

TEST(Relaxation, AnswersASmallLoadInProportion) {
  const auto answer = [](double load) {
    Model model = uniaxial(1, 4);
    for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
      if (model.cloud.positions(a, 2) > side - 1e-9) {
        model.conditions.displacement(a, 2) = -load;
      }
    }
    return Points(solve(model, {}).solution.displacement / load);
  };
  EXPECT_LE((answer(1e-6) - answer(1e-3)).cwiseAbs().maxCoeff(), 0.01);
}

TEST(Relaxation, SaysAtOnceThatRoundingKeepsItFromTheTolerance) {
  SolveOptions options;
  options.tolerance = 1e-15;
  const SolveResult result = solve(uniaxial(0.9, 5), options);
  EXPECT_THAT(result.failure, testing::HasSubstr("moves by no more than rounding"));
  EXPECT_THAT(result.failure, testing::HasSubstr("1e-15 mm are wanted; take a larger tolerance"));
  EXPECT_LT(result.measures.steps, 3000);
  EXPECT_FALSE(result.measures.converged);
}

/// Tissue that hardly changes its volume, pressed fast: most of the work goes into the damping, and the masses are made
/// anew on the way.
TEST(Relaxation, BalancesItsEnergiesWhileItsMassesGrow) {
  Model model = uniaxial(0.7, 5);
  model.materials[1].poisson_ratio = 0.4999;
  SolveOptions options;
  options.load_steps = 200;
  options.max_steps = 400;  // it need not come to rest
  double most = 0;
  for (const HistoryRow& row : solve(model, options).history) {
    most = std::max(most, row.external_work);
    EXPECT_NEAR(row.strain_energy + row.kinetic_energy + row.dissipated_energy, row.external_work, 0.005 * most)
        << "at step " << row.step;
  }
}

/// A stiff half upon a soft one, pushed aside: in single precision it ends three times its bound off.
TEST(Relaxation, BoundsTheErrorOfAStiffPartThatWeighsOnASoftOne) {
  Model model = box_model(test::box_cells(4, side), 5);
  test::label_cells(model.cells, [](const Eigen::RowVector3d& low) { return low[2] < side / 2 - 1 ? 1 : 2; });
  model.materials[2] = {1.5e6, 0.49, 1000};
  hold_bottom(model);
  model.gravity = {1, 0.5, -1};
  SolveOptions loose, tight;
  loose.shape.basis = tight.shape.basis = Basis::linear;
  loose.precision = tight.precision = Precision::single_precision;  // double is taken all the same
  loose.tolerance = 0.02;
  tight.tolerance = 1e-3;
  const SolveResult result = solve(model, loose), exact = solve(model, tight);
  EXPECT_EQ(result.failure + exact.failure, "");
  const double error = (exact.solution.displacement - result.solution.displacement).rowwise().norm().maxCoeff();
  EXPECT_LE(error, result.measures.error_bound + exact.measures.error_bound);
}

/// As of two layers of nodes between bonded plates. From a coarse solution on only rounding moves.
/// An Ogden tissue has no stiffness there, and one that is nearly so has an enormous one.
TEST(Relaxation, GoesOnFromRestWhereItsStartTurnsPointsInsideOut) {
  Model model = uniaxial(0.75, 5);
  model.materials[1] = named_material("brain_ogden").value();
  const SolveResult right = solve(model, {});
  model.last.emplace();
  model.last->positions = model.cloud.positions;
  model.last->spacing = model.cloud.spacing;
  model.last->displacement = -1.5 * model.cloud.positions;
  SolveOptions options;
  options.start = Start::coarse;
  const SolveResult result = solve(model, options);
  ASSERT_TRUE(result.failure.empty()) << result.failure;
  EXPECT_LE((result.solution.displacement - right.solution.displacement).rowwise().norm().maxCoeff(), 0.02);
}

TEST(Relaxation, EndsWhereEveryNodeIsHeld) {
  const Eigen::Matrix3d stretch = Eigen::Vector3d(0.02, 0.02, -0.05).asDiagonal();
  Model model = box_model(test::box_cells(5, side), 8);
  model.conditions.displacement = model.cloud.positions * stretch;
  SolveOptions options;
  options.start = Start::coarse;
  options.precision = Precision::single_precision;
  const SolveResult result = solve(model, options);
  EXPECT_EQ(result.failure, "");
  EXPECT_LT(difference_from(result.solution, stretch), 1e-9);
  EXPECT_LT(result.measures.steps, 400) << "as long as a standstill lasts that is none of rest";
}

}  // namespace brainshift::solve::relaxation_test
