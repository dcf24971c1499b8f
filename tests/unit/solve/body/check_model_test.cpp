// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/body/check_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/models.hpp"
#include "tests/unit/solve/pulled_square.hpp"
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

TEST(CheckModel, RefusesWhatLeavesThePlane) {
  const std::function<void(Model&)> faults[] = {[](Model& m) {
                                                  m.gravity = {0, 0, -9.81};
                                                },
                                                [](Model& m) { m.conditions.displacement(0, 2) = 1; },
                                                [](Model& m) {
                                                  m.conditions.force = Points::Zero(m.cloud.positions.rows(), 3);
                                                  m.conditions.force(7, 2) = 0.1;
                                                }};
  Model within = pulled_square();
  within.gravity = {0, -9.81, 0};
  within.conditions.displacement(0, 2) = 0;
  EXPECT_EQ(test::refusal([&] { check_model(within); }), "");
  for (const auto& fault : faults) {
    Model model = pulled_square();
    fault(model);
    EXPECT_NE(test::refusal([&] { check_model(model); }).find("have no z"), std::string::npos);
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

TEST(CheckInput, NamesWhatIsNotAsItMustBe) {
  const std::pair<std::function<void(Model&)>, const char*> faults[] = {
      {[](Model& m) { m.cloud.spacing.pop_back(); }, "one a node"},
      {[](Model& m) { m.cloud.on_surface.clear(); }, "one a node"},
      {[](Model& m) { m.cloud.spacing[7] = 0; }, "node 7 has spacing"},
      {[](Model& m) { m.cloud.positions(7, 1) = std::nan(""); }, "node 7 is not finite"},
      {[](Model& m) { m.cloud = {}; }, "at least two"},
      {[](Model& m) { m.conditions.displacement.conservativeResize(10, 3); }, "10 rows for 64 nodes"},
      {[](Model& m) { m.conditions.displacement(3, 1) = INFINITY; }, "node 3 is infinite"},
      {[](Model& m) { m.conditions.force.setConstant(64, 3, std::nan("")); }, "force on node 0"},
      {[](Model& m) { m.cells.connectivity[5] = 100000; }, "cell 0 has a corner"},
      {[](Model& m) { m.materials[1].law = Law::own; }, "label 1"},
      {[](Model& m) {
         m.gravity = {0, std::nan(""), 0};
       },
       "gravity is not finite"},
      {[](Model& m) {
         m.body_force = [](const Eigen::Vector3d&, std::int32_t) -> Eigen::Vector3d { return {0, NAN, 0}; };
       },
       "body force at"},
  };
  for (const auto& [change, sentence] : faults) {
    Model model = uniaxial(0.9, 4);
    change(model);
    EXPECT_NE(refusal(model).find(sentence), std::string::npos) << sentence << ": " << refusal(model);
  }
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
  const Model still = with_loose_twin();
  EXPECT_EQ(refusal(still), "") << "it stays";
  const Eigen::Vector3d down(0, 0, -1);
  const std::function<void(Model&)> pushes[] = {
      [&](Model& m) { m.gravity = down; },
      [&](Model& m) { m.fluid = DrainedFluid{.gravity = down, .gravity_of_image = down, .level = 0}; },
      [](Model& m) { m.materials[1].swelling = 0.1; },
  };
  for (const auto& push : pushes) {
    Model model = still;
    push(model);
    EXPECT_NE(refusal(model).find("in parts, and the part about (210"), std::string::npos) << refusal(model);
  }
}

/// Forces at some nodes, and a skull that stops all.
TEST(CheckModel, WantsNoPartHeldThatTheSkullStops) {
  OrderedCloud cloud;
  cloud.positions = test::irregular_box(3, 60).positions;
  cloud.conditions.force = Points::Zero(cloud.positions.rows(), 3);
  cloud.conditions.force(0, 2) = -1;
  ShapeRows points;
  const std::vector<double> half(2, 0.5);
  for (std::int32_t a = 0; a + 1 < cloud.positions.rows(); ++a) {
    const std::vector<std::int32_t> pair = {a, a == 12 ? a : a + 1};  // 0 to 12, and the others
    points.append({pair, half, {}});
  }
  Model model;
  EXPECT_NE(test::refusal([&] { check_parts_held(cloud, points, model); }).find("left in parts"), std::string::npos);
  model.skull.emplace();
  EXPECT_EQ(test::refusal([&] { check_parts_held(cloud, points, model); }), "");
}

}  // namespace brainshift::solve::check_model_test
