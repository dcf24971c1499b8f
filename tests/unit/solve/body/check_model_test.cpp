// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/body/check_model.hpp"

#include <gtest/gtest.h>

#include <vector>

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

template <class Value>
void append_twin(std::vector<Value>& values, Value more = {}) {
  const std::vector<Value> first = values;
  for (const Value value : first) {
    values.push_back(value + more);
  }
}

void append_twin(Points& positions, const Eigen::RowVector3d& aside) {
  const Points first = positions;
  positions.resize(2 * first.rows(), 3);
  positions << first, first.rowwise() + aside;
}

/// A cube that is pressed, and one beside it that nothing holds.
Model with_loose_twin() {
  const Eigen::RowVector3d aside(3 * model_side, 0, 0);
  Model model = uniaxial(0.9, 4);
  const Points prescribed = model.conditions.displacement;
  append_twin(model.cells.connectivity, static_cast<std::int32_t>(model.cells.vertices.rows()));
  append_twin(model.cells.vertices, aside);
  append_twin(model.cells.inside_fraction);
  append_twin(model.cells.label);
  append_twin(model.cloud.positions, aside);
  append_twin(model.cloud.spacing);
  append_twin(model.cloud.on_surface);
  model.conditions = test::all_free(model.cloud);
  model.conditions.displacement.topRows(prescribed.rows()) = prescribed;
  return model;
}

TEST(CheckModel, WantsEachPartHeldWhereSomethingPushesIt) {
  Model model = with_loose_twin();
  EXPECT_EQ(refusal(model), "") << "it stays";
  model.gravity = {0, 0, -1};
  EXPECT_NE(refusal(model).find("in parts, and the part about (210"), std::string::npos) << refusal(model);
}

}  // namespace brainshift::solve::check_model_test
