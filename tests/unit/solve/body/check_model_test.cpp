// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/body/check_model.hpp"

#include <gtest/gtest.h>

#include "tests/unit/solve/models.hpp"
#include "tests/unit/solve/specimen.hpp"

namespace brainshift::solve::check_model_test {

TEST(Diagnosis, RefusesNodesNearlyInOnePlace) {
  Model model = uniaxial(0.9, 4);
  model.cloud.positions.row(21) = model.cloud.positions.row(22) + Eigen::RowVector3d(1e-3, 0, 0);
  try {
    solve(model, {});
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("mm apart"), std::string::npos) << error.what();
  }
}

std::string refusal(const Model& model) {
  try {
    solve(model, {});
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(CheckModel, WantsSomethingThatMovesAndSomethingThatHolds) {
  Model model = box_model(test::box_cells(3, model_side), 4);
  EXPECT_NE(refusal(model).find("give a load"), std::string::npos);
  model.gravity = {0, 0, -9.81};
  EXPECT_NE(refusal(model).find("nothing holds the body"), std::string::npos) << refusal(model);
  model.gravity.setZero();
  model.materials[1].swelling = 0.1;
  EXPECT_NE(refusal(model).find("nothing holds the body"), std::string::npos) << refusal(model);
}

}  // namespace brainshift::solve::check_model_test
