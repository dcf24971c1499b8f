// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/relaxation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

}  // namespace brainshift::solve::relaxation_test
