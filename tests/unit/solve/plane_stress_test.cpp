// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/solve.hpp"

#include <gtest/gtest.h>

#include "solve/force/patch_dilatation.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/material_cases.hpp"
#include "tests/unit/solve/specimen.hpp"

namespace brainshift::solve::plane_stress_test {

using test::irregular_rectangle;
using test::rectangle_cells;

constexpr double width = 60, height = 30;

class PlaneStress : public testing::TestWithParam<Material> {
 protected:
  ElasticLaw law = elastic_law(GetParam());

  Specimen body() const {
    return {irregular_rectangle(9, 6, width, height),
            rectangle_cells(10, 5, width, height),
            {GetParam()},
            {.nodes_per_patch = 0, .points_per_cell = 4, .plane_stress = true}};
  }

  /// The lateral stretch of uniaxial tension, equal in y and z, by bisection; P_11 at it.
  std::pair<double, double> uniaxial(double stretch) const {
    double low = 0.5, high = 1.5;
    while (high - low > 1e-13) {
      const double middle = (low + high) / 2;
      const Eigen::Matrix3d f = Eigen::Vector3d(stretch, middle, middle).asDiagonal();
      (stress(law, f)(1, 1) > 0 ? high : low) = middle;
    }
    return {low, stress(law, Eigen::Vector3d(stretch, low, low).asDiagonal())(0, 0)};
  }
};

INSTANTIATE_TEST_SUITE_P(Material, PlaneStress, testing::ValuesIn(every_law),
                         [](const auto& tested) { return name_of(tested.param); });

TEST_P(PlaneStress, LeavesNoStressAcrossTheThickness) {
  Specimen b = body();
  b.force(b.random_parameters(0.8));
  const double modulus = std::visit([](const auto& l) { return l.bulk_modulus; }, law);
  double largest_change = 0;
  for (const Patch& patch : b.points.patches) {
    for (const Eigen::Matrix3d& f : gradients_of(b.points, patch, b.scratch)) {
      EXPECT_LE(std::abs(stress(law, f)(2, 2)), 1e-9 * modulus);
      largest_change = std::max(largest_change, std::abs(f(2, 2) - 1));
    }
  }
  EXPECT_GE(largest_change, 1e-3);
}

TEST_P(PlaneStress, ForceIsTheDerivativeOfTheStrainEnergy) {
  Specimen b = body();
  const NodalVectors u = b.random_parameters(0.5);
  const NodalVectors f = b.force(u);
  constexpr double step = 1e-5;
  for (std::size_t a = 0; a < b.cloud.size(); a += 5) {
    const std::size_t i = 4 * a + a % 2;
    NodalVectors ahead = u, behind = u;
    ahead[i] += step;
    behind[i] -= step;
    EXPECT_NEAR((b.energy(ahead) - b.energy(behind)) / (2 * step), f[i], 1e-5 * largest(f));
  }
  EXPECT_LE(resultant(f).norm(), 1e-9 * largest(f));
}

TEST_P(PlaneStress, StoresTheEnergyOfUniaxialTension) {
  Specimen b = body();
  const double stretch = 1.1;
  const auto [lateral, tension] = uniaxial(stretch);
  const Eigen::Matrix3d f = Eigen::Vector3d(stretch, lateral, lateral).asDiagonal();
  Eigen::Matrix3d in_plane = f - Eigen::Matrix3d::Identity();
  in_plane(2, 2) = 0;
  const double expected = width * height * energy(law, f);
  EXPECT_NEAR(b.energy(b.linear(in_plane)), expected, 1e-8 * expected);
}

TEST_P(PlaneStress, PullsBackOnAStretchedRectangleAsTheAnalyticSolutionSays) {
  const double stretch = 1.1;
  Model model;
  model.plane = Plane::stress;
  model.cloud = irregular_rectangle(9, 6, width, height);
  model.conditions = test::all_free(model.cloud);
  model.cells = rectangle_cells(10, 5, width, height);
  model.materials[1] = GetParam();
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    auto prescribed = model.conditions.displacement.row(a);
    const double x = model.cloud.positions(a, 0);
    prescribed[0] = x < 1e-9 ? 0 : (x > width - 1e-9 ? (stretch - 1) * width : std::nan(""));
    prescribed[1] = model.cloud.positions(a, 1) < 1e-9 ? 0 : std::nan("");
  }
  SolveOptions options;
  options.points_per_cell = 4;
  options.tolerance = 1e-4;
  options.load_steps = 200;
  const SolveResult result = solve(model, options);
  ASSERT_TRUE(result.measures.converged) << result.failure;
  const auto [lateral, tension] = uniaxial(stretch);
  const double expected = tension * height * 1e-6;  // N on 1 mm of thickness
  EXPECT_NEAR(result.history.back().reaction.x(), expected, 0.01 * std::abs(expected));
  // What plain integration leaves shows most at a free corner.
  const Eigen::Index corner = model.cloud.positions.rows() - 1;
  EXPECT_NEAR(result.solution.displacement(corner, 1), (lateral - 1) * height, 0.02 * height * (stretch - 1));
}

}  // namespace brainshift::solve::plane_stress_test
