// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/relaxation.hpp"

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

}  // namespace brainshift::solve::relaxation_test
