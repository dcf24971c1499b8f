// SPDX-License-Identifier: GPL-3.0-or-later

#include "solve/cut/resection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "solve/body/ordered_cloud.hpp"
#include "tests/unit/solve/cut_bodies.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::resection_test {

constexpr double side = model_side;
constexpr int n = 13;
constexpr double spacing = side / (n - 1);

/// A cube, two cells from node to node, of tissue 1 with tissue 2 in the cells whose centres `is_second` takes. It
/// stands on nodes that do not move.
Model of_two_tissues(const std::function<bool(const Eigen::RowVector3d&)>& is_second, int nodes = n) {
  Model model = box_model(test::box_cells(2 * (nodes - 1), side), nodes);
  for (std::size_t cell = 0; cell < model.cells.size(); ++cell) {
    const Eigen::RowVector3d low = model.cells.vertices.row(model.cells.connectivity[8 * cell]);
    const Eigen::RowVector3d high = model.cells.vertices.row(model.cells.connectivity[8 * cell + 6]);
    model.cells.label[cell] = is_second((low + high) / 2) ? 2 : 1;
  }
  hold_bottom(model);
  return model;
}

bool is_in_core(const Eigen::RowVector3d& x) {
  return (x.array() - side / 2).abs().maxCoeff() < side / 4;
}

bool is_above(const Eigen::RowVector3d& x) {
  return x[2] > side / 2;
}

SolveOptions coarse_options() {
  SolveOptions options;
  options.points_per_cell = 1;
  options.tolerance = 1e-3;
  return options;
}

/// What is left when 100 Pa press in the cavity.
Model pressed(Model model) {
  model.resection = Resection{{2}, 100};
  return resect(model, coarse_options()).rest;
}

constexpr double newton = 1e-6;  // Pa mm² to N

TEST(Resection, PressureInAClosedCavityPushesItAllWaysAlike) {
  const Model left = pressed(of_two_tissues(is_in_core));
  const Points& force = left.conditions.force;
  const double volume = std::pow(side / 2, 3), area = 6 * side * side / 4;
  EXPECT_LE(force.colwise().sum().norm(), 1e-3 * 100 * area * newton);
  // ∫_wall n ⊗ X dA is the volume times 1.
  const Eigen::Matrix3d moment = force.transpose() * left.cloud.positions / (100 * volume * newton);
  EXPECT_LE((moment - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 0.01) << moment;
}

TEST(Resection, PressurePushesOnAWallAndNotWhereTheCavityLiesOpen) {
  const Model left = pressed(of_two_tissues(is_above));
  const Points& force = left.conditions.force;
  const double whole = 100 * side * side * newton;
  EXPECT_NEAR(force.col(2).sum(), -whole, 0.01 * whole);
  EXPECT_LE(force.leftCols<2>().colwise().sum().norm(), 0.01 * whole);
  EXPECT_LE(force.col(0).cwiseAbs().sum(), 0.1 * whole);
  for (Eigen::Index a = 0; a < force.rows(); ++a) {
    if (std::abs(left.cloud.positions(a, 2) - side / 2) > 2.5 * spacing) {
      EXPECT_LE(force.row(a).norm(), 1e-4 * whole);
    }
  }
}

TEST(Resection, LeavesABodyThatNeverHadTheTissue) {
  Model model = of_two_tissues(is_above, 7);
  model.gravity = {2, 0, -9.81};
  model.resection = Resection{{2}, 0};
  const SolveResult taken_out = solve(model, coarse_options());

  Model half = box_model(test::box_cells({12, 12, 6}, {side, side, side / 2}), 7);
  half.boundary = Surface();  // as unknown as the wall of what was taken out
  half.gravity = model.gravity;
  std::vector<std::int32_t> nodes;
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if (model.cloud.positions(a, 2) < side / 2 + 0.5 * side / 6) {
      nodes.push_back(static_cast<std::int32_t>(a));
    }
  }
  half.cloud = subset(model.cloud, nodes);
  half.conditions = subset(model.conditions, nodes);
  for (std::size_t a = 0; a < half.cloud.size(); ++a) {
    if (half.cloud.positions(static_cast<Eigen::Index>(a), 2) > 0.4 * side) {
      half.cloud.on_surface[a] = 1;
    }
  }
  const SolveResult never_there = solve(half, coarse_options());
  ASSERT_TRUE(taken_out.measures.converged && never_there.measures.converged);
  ASSERT_EQ(taken_out.solution.positions, half.cloud.positions);
  EXPECT_EQ(taken_out.solution.displacement, never_there.solution.displacement);
  EXPECT_EQ(taken_out.measures.resection->removed_nodes, model.cloud.size() - half.cloud.size());
  EXPECT_NEAR(taken_out.measures.resection->removed_volume, std::pow(side, 3) / 2, 1e-6);
}

TEST(Resection, ALabelMapCutsThroughCells) {
  Model model = of_two_tissues([](const Eigen::RowVector3d&) { return false; }, 5);
  LabelMap labels;
  labels.geometry.size = {1, 1, 32};
  labels.geometry.spacing = {4 * side, 4 * side, side / 32};
  labels.geometry.origin = {side / 2, side / 2, side / 64};
  for (int k = 0; k < 32; ++k) {
    labels.voxels.push_back(k < 18 ? 1 : 2);  // the wall lies amid a layer of cells
  }
  model.labels = labels;
  model.resection = Resection{{2}, 0};
  SolveOptions options = coarse_options();
  options.points_per_cell = 8;
  options.max_steps = 20;  // it need not come to rest
  const SolveResult result = solve(model, options);
  EXPECT_EQ(result.measures.integration_points, 8 * 8 * 8 * 8 / 16 * 9);
  EXPECT_NEAR(result.measures.resection->removed_volume, std::pow(side, 3) * 7 / 16, 1e-6);
  options.integration_tolerance = 0.1;
  options.max_steps = SolveOptions().max_steps;
  EXPECT_TRUE(solve(model, options).measures.converged);
}

TEST(Resection, GoesWithACutThatLeadsToTheCavity) {
  Model model = test::strip(1.1);
  for (std::size_t cell = 0; cell < model.cells.size(); ++cell) {
    const Eigen::RowVector3d low = model.cells.vertices.row(model.cells.connectivity[4 * cell]);
    model.cells.label[cell] = low[0] > 9 && low[0] < 19 && low[1] > 4 && low[1] < 13 ? 2 : 1;
  }
  model.resection = Resection{{2}, 0};
  SolveOptions options;
  options.points_per_cell = 4;
  const auto pull = [&] {
    const SolveResult result = solve(model, options);
    EXPECT_TRUE(result.measures.converged) << result.failure;
    return result.history.back().reaction.x();
  };
  const double emptied = pull();
  model.cuts = {test::cut_path({{15, 25}, {15, 10}})};
  const double cut = pull();
  EXPECT_LT(cut, 0.8 * emptied);
  model.cuts = {test::cut_path({{15, 25}, {15, 10}}, {0, 0.5})};
  EXPECT_NEAR(pull(), cut, 0.03 * emptied);
}

/// What solve() says against taking labels out of a model; empty: nothing.
std::string fault(Model model, const std::vector<std::int32_t>& labels) {
  model.resection = Resection{labels, 0};
  try {
    solve(model, coarse_options());
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Resection, RefusesWhatCannotBeTakenOut) {
  const Model good = of_two_tissues(is_above, 7);
  EXPECT_EQ(fault(good, {2}), "");
  EXPECT_NE(fault(good, {2, 7}).find("label 7, which no integration point"), std::string::npos);
  EXPECT_NE(fault(good, {1, 2}).find("the whole body"), std::string::npos);
  EXPECT_NE(fault(good, {}).find("names no label"), std::string::npos);
  Model model = good;
  const Eigen::Index top = model.cloud.positions.rows() - 1;
  model.conditions.displacement(top, 0) = 1;
  EXPECT_NE(fault(model, {2}).find("has a prescribed displacement, but lies in the tissue"), std::string::npos);
  model = good;
  model.conditions.force = Points::Zero(top + 1, 3);
  model.conditions.force(top, 0) = 1;
  EXPECT_NE(fault(model, {2}).find("has a force, but lies in the tissue"), std::string::npos);
}

TEST(Resection, RefusesToLeaveAPartThatNothingHolds) {
  const auto in_layer = [](const Eigen::RowVector3d& x) { return x[2] > side / 4 && x[2] < 0.7 * side; };
  const Model model = of_two_tissues(in_layer);
  EXPECT_NE(fault(model, {2}).find("in parts, and the part about"), std::string::npos) << fault(model, {2});
  Model held = model;
  for (Eigen::Index a = 0; a < held.cloud.positions.rows(); ++a) {
    if (held.cloud.positions(a, 2) > side - 1e-9) {
      held.conditions.displacement.row(a).setZero();
    }
  }
  EXPECT_EQ(fault(held, {2}), "");
}

}  // namespace brainshift::solve::resection_test
