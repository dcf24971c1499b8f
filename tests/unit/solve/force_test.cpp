// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/unit/solve/models.hpp"

namespace brainshift::solve {
namespace {

constexpr double side = model_side;

/// A cube that stands on a frictionless floor.
Model standing(const Material& material) {
  Model model = uniaxial(1);
  model.materials[1] = material;
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if (model.cloud.positions(a, 2) > side - 1e-9) {
      model.cloud.prescribed_displacement(a, 2) = std::nan("");
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
  Model model = standing({.youngs_modulus = 3000, .poisson_ratio = 0.49});
  model.gravity = {1, -2, -9.81};
  model.body_force = [](const Eigen::Vector3d& x, std::int32_t) { return Eigen::Vector3d(0, 0, 1e-8 * x.x()); };
  const auto nodes = model.cloud.positions.rows();
  model.cloud.force = Points::Zero(nodes, 3);
  model.cloud.force.row(nodes - 1) << 0.01, 0.02, -0.03;
  const SolveResult result = solve(model, tight());
  ASSERT_TRUE(result.measures.converged) << result.failure;
  const double mass = 1000e-9 * side * side * side;                                // kg
  const Eigen::Vector3d pushed(0.01, 0.02, -0.03 + 1e-8 * std::pow(side, 4) / 2);  // N
  const Eigen::Vector3d applied = pushed + mass * model.gravity;
  const Eigen::Vector3d reaction = result.solution.reaction_force.colwise().sum();
  EXPECT_LE((reaction + applied).norm(), 1e-4 * applied.norm());
}

TEST(Forces, StretchABarUnderItsOwnWeightAsTheAnalyticSolutionSays) {
  Model model = standing({.youngs_modulus = 3000, .poisson_ratio = 0, .law = Law::linear_elastic});
  model.gravity = {0, 0, 9.81};  // hangs from z = 0
  for (const Imposition imposition : {Imposition::exact, Imposition::simplified}) {
    SolveOptions options = tight();
    options.imposition = imposition;
    const SolveResult result = solve(model, options);
    ASSERT_TRUE(result.measures.converged) << result.failure;
    const double tip = 1000 * 9.81 / 3000 * side * side / 2 * 1e-3;  // ρ g L²/2E, mm
    for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
      const double z = model.cloud.positions(a, 2) / side;
      EXPECT_NEAR(result.solution.displacement(a, 2), tip * z * (2 - z), 0.015 * tip);
      EXPECT_LE(result.solution.displacement.row(a).head<2>().norm(), 0.01 * tip);
    }
  }
}

TEST(Forces, DoTheWorkThatStretchingStoresAndDampingTakes) {
  Model model = standing({.youngs_modulus = 3000, .poisson_ratio = 0.4});
  model.gravity = {0, 0, 9.81};
  const SolveResult result = solve(model, tight());
  ASSERT_TRUE(result.measures.converged) << result.failure;
  const HistoryRow last = result.history.back();
  EXPECT_NEAR(last.external_work, last.strain_energy + last.kinetic_energy + last.dissipated_energy,
              0.01 * last.external_work);
}

TEST(Forces, AtTheTopSumToTheStressOfUniaxialTension) {
  const Material material{.youngs_modulus = 3000, .poisson_ratio = 0.45};
  Model model = standing(material);
  const double stretch = 1.2;
  const auto [stress, lateral] = uniaxial_answer(material, stretch);
  // Forces at the nodes that are those of a uniform traction: a linear function integrated by the trapezoidal rule.
  model.cloud.force = Points::Zero(model.cloud.positions.rows(), 3);
  const auto share = [](double x) { return x < 1e-9 || x > side - 1e-9 ? 0.5 : 1.0; };
  const double pitch = model.cloud.spacing[0];
  Eigen::Vector3d total = Eigen::Vector3d::Zero();
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const Eigen::RowVector3d x = model.cloud.positions.row(a);
    if (x.z() > side - 1e-9) {
      model.cloud.force(a, 2) = share(x.x()) * share(x.y()) * pitch * pitch * stress * 1e-6;
      total.z() += model.cloud.force(a, 2);
    }
  }
  const SolveResult result = solve(model, tight());
  ASSERT_TRUE(result.measures.converged) << result.failure;
  double mean = 0, nodes = 0;
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const bool top = model.cloud.positions(a, 2) > side - 1e-9;
    mean += top ? result.solution.displacement(a, 2) : 0;
    nodes += top ? 1 : 0;
  }
  EXPECT_NEAR(mean / nodes, (stretch - 1) * side, 0.03 * (stretch - 1) * side);
  EXPECT_EQ(result.history.back().reaction.norm(), 0);  // nothing is moved
  EXPECT_NEAR(result.solution.reaction_force.col(2).sum(), -total.z(), 1e-4 * total.z());
}

TEST(Forces, FollowTheCurveBackToNothing) {
  Model model = standing({.youngs_modulus = 3000, .poisson_ratio = 0.4});
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

}  // namespace
}  // namespace brainshift::solve
