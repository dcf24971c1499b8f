// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/solve.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::forces_test {

constexpr double side = model_side;

/// A cube of n³ nodes that stands on a frictionless floor.
Model standing(const Material& material, int n) {
  Model model = uniaxial(1, n);
  model.materials[1] = material;
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if (model.cloud.positions(a, 2) > side - 1e-9) {
      model.conditions.displacement(a, 2) = std::nan("");
    }
  }
  return model;
}

SolveOptions tight() {
  SolveOptions options;
  options.tolerance = 1e-5;
  return options;
}

TEST(Forces, AreBalancedByTheReactions) {
  Model model = standing({.youngs_modulus = 3000, .poisson_ratio = 0.49}, 5);
  model.gravity = {1, -2, -9.81};
  model.body_force = [](const Eigen::Vector3d& x, std::int32_t) { return Eigen::Vector3d(0, 0, 1e-8 * x.x()); };
  const auto nodes = model.cloud.positions.rows();
  model.conditions.force = Points::Zero(nodes, 3);
  model.conditions.force.row(nodes - 1) << 0.01, 0.02, -0.03;
  const SolveResult result = solve(model, tight());
  ASSERT_TRUE(result.measures.converged) << result.failure;
  const double mass = 1000e-9 * side * side * side;                                // kg
  const Eigen::Vector3d pushed(0.01, 0.02, -0.03 + 1e-8 * std::pow(side, 4) / 2);  // N
  const Eigen::Vector3d applied = pushed + mass * model.gravity;
  const Eigen::Vector3d reaction = result.solution.reaction_force.colwise().sum();
  EXPECT_LE((reaction + applied).norm(), 1e-4 * applied.norm());
}

/// Mean of u_z over the nodes at the top, weighted.
double top_displacement(const Solution& solution, const std::function<double(Eigen::Index)>& weight) {
  double sum = 0, weights = 0;
  for (Eigen::Index a = 0; a < solution.positions.rows(); ++a) {
    if (solution.positions(a, 2) > side - 1e-9) {
      sum += weight(a) * solution.displacement(a, 2);
      weights += weight(a);
    }
  }
  return sum / weights;
}

TEST(Forces, StretchABarUnderItsOwnWeightAsTheAnalyticSolutionSays) {
  Model model = standing({.youngs_modulus = 3000, .poisson_ratio = 0, .law = Law::linear_elastic}, 7);
  model.gravity = {0, 0, 9.81};                                    // hangs from z = 0
  const double tip = 1000 * 9.81 / 3000 * side * side / 2 * 1e-3;  // ρ g L²/2E, mm
  for (const Basis basis : {Basis::linear, Basis::modified_quadratic}) {
    SolveOptions options = tight();
    options.shape.basis = basis;
    const SolveResult result = solve(model, options);
    ASSERT_TRUE(result.measures.converged) << result.failure;
    EXPECT_NEAR(top_displacement(result.solution, [](Eigen::Index) { return 1.0; }), tip, 0.02 * tip);
    double squares = 0;
    for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
      const double z = model.cloud.positions(a, 2) / side;
      const Eigen::RowVector3d expected(0, 0, tip * z * (2 - z));
      squares += (result.solution.displacement.row(a) - expected).squaredNorm();
    }
    const double error = std::sqrt(squares / static_cast<double>(model.cloud.size())) / tip;
    RecordProperty(basis == Basis::linear ? "linear" : "modified", std::to_string(error));
    EXPECT_LE(error, 0.02);
  }
}

TEST(Forces, DoTheWorkThatStretchingStoresAndDampingTakes) {
  Model model = standing({.youngs_modulus = 3000, .poisson_ratio = 0.4}, 5);
  model.gravity = {0, 0, 9.81};
  const SolveResult result = solve(model, tight());
  ASSERT_TRUE(result.measures.converged) << result.failure;
  const HistoryRow last = result.history.back();
  EXPECT_NEAR(last.external_work, last.strain_energy + last.kinetic_energy + last.dissipated_energy,
              1e-3 * last.external_work);
}

TEST(Forces, AtTheTopSumToTheStressOfUniaxialTension) {
  const Material material{.youngs_modulus = 3000, .poisson_ratio = 0.45};
  Model model = standing(material, 7);
  const double stretch = 1.2;
  const auto [stress, lateral] = uniaxial_answer(material, stretch);
  // A uniform traction as forces at the nodes, by the trapezoidal rule.
  model.conditions.force = Points::Zero(model.cloud.positions.rows(), 3);
  const auto share = [](double x) { return x < 1e-9 || x > side - 1e-9 ? 0.5 : 1.0; };
  const double pitch = model.cloud.spacing[0];
  double total = 0;
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const Eigen::RowVector3d x = model.cloud.positions.row(a);
    if (x.z() > side - 1e-9) {
      model.conditions.force(a, 2) = share(x.x()) * share(x.y()) * pitch * pitch * stress * 1e-6;
      total += model.conditions.force(a, 2);
    }
  }
  SolveOptions options = tight();
  options.shape.basis = Basis::linear;
  const SolveResult result = solve(model, options);
  ASSERT_TRUE(result.measures.converged) << result.failure;
  const double moved = top_displacement(result.solution, [&](Eigen::Index a) { return model.conditions.force(a, 2); });
  EXPECT_NEAR(moved, (stretch - 1) * side, 0.03 * (stretch - 1) * side);
  EXPECT_EQ(result.history.back().reaction.norm(), 0);  // nothing is moved
  EXPECT_NEAR(result.solution.reaction_force.col(2).sum(), -total, 1e-4 * total);
}

TEST(Forces, FollowTheCurveBackToNothing) {
  Model model = standing({.youngs_modulus = 3000, .poisson_ratio = 0.4}, 5);
  model.gravity = {0, 0, -9.81};
  model.curve = LoadCurve({0, 1, 2}, {0, 1, 0}, LoadCurve::Join::smooth);
  const SolveResult result = solve(model, tight());
  ASSERT_TRUE(result.measures.converged) << result.failure;
  EXPECT_LE(result.measures.largest_displacement, 1e-4);
  double deepest = 0;
  for (const HistoryRow& row : result.history) {
    deepest = std::max(deepest, row.strain_energy);
  }
  EXPECT_GT(deepest, 1e3 * result.history.back().strain_energy);
}

}  // namespace brainshift::solve::forces_test
