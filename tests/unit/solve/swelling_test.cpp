// SPDX-License-Identifier: GPL-3.0-or-later

// Tissues that grow or shrink: F = s F_e with s³ the volume at rest.
#include <gtest/gtest.h>

#include "solve/force/stiffness_bound.hpp"
#include "solve/solve.hpp"
#include "tests/unit/solve/models.hpp"
#include "tests/unit/solve/specimen.hpp"

namespace brainshift::solve::swelling_test {

constexpr double side = model_side;

Specimen grown(Material material, double swelling, double fraction) {
  material.swelling = swelling;
  Specimen body{test::irregular_box(4, side), test::box_cells(3, side), {material}, SpecimenOptions{}};
  body.scratch.swell(body.laws, fraction);
  return body;
}

class Swelling : public testing::TestWithParam<Material> {};

INSTANTIATE_TEST_SUITE_P(Laws, Swelling, testing::ValuesIn(every_law));

TEST_P(Swelling, LeavesAFreeBodyWithoutStressAtItsNewSize) {
  for (const double swelling : {-0.5, 0.05, 2.0}) {
    Specimen body = grown(GetParam(), swelling, 1);
    const double more = std::cbrt(1 + swelling) - 1;
    const double pressed = largest(grown(GetParam(), 0, 1).force(body.linear(more * Eigen::Matrix3d::Identity())));
    EXPECT_LE(largest(body.force(body.linear(more * Eigen::Matrix3d::Identity()))), 1e-10 * pressed) << swelling;
    const PointState state = point_state(body.points, body.laws, body.scratch);
    EXPECT_NEAR(state.smallest_jacobian, std::min(1.0, 1 + swelling), 1e-10);
    EXPECT_GT(largest(body.force(body.rest())), 0.01 * pressed) << "held at its old size it pushes";
  }
}

/// Tissue creases by what presses it elastically, not by having shrunk.
TEST(SwellingWithoutStress, MakesNoCreases) {
  Specimen body = grown(Material{}, -0.9, 1);
  const double less = std::cbrt(0.1) - 1;
  ASSERT_LT(1 + less, crease_stretch);
  body.force(body.linear(less * Eigen::Matrix3d::Identity()));
  EXPECT_EQ(point_state(body.points, body.laws, body.scratch).compressed_share, 0);
}

TEST_P(Swelling, ForceIsTheSlopeOfTheEnergy) {
  Specimen body = grown(GetParam(), 0.4, 0.5);
  const NodalVectors at_rest = body.random_parameters(0.5);
  const NodalVectors direction = body.random_parameters(1, 5);
  const NodalVectors force = body.force(at_rest);
  double power = 0;
  for (std::size_t i = 0; i < force.size(); ++i) {
    power += force[i] * direction[i];
  }
  const auto energy_along = [&](double h) {
    NodalVectors u = at_rest;
    for (std::size_t i = 0; i < u.size(); ++i) {
      u[i] += h * direction[i];
    }
    return body.energy(u);
  };
  constexpr double h = 1e-4;
  EXPECT_NEAR((energy_along(h) - energy_along(-h)) / (2 * h), power, 1e-6 * std::abs(power));
}

TEST(SwellingOfTwoTissues, IsThatOfEach) {
  Material quiet{.poisson_ratio = 0.4}, swollen = quiet;
  swollen.swelling = 0.3;
  Specimen body{test::irregular_box(4, side), test::box_cells(4, side), {quiet, swollen}, SpecimenOptions{}};
  body.scratch.swell(body.laws, 1);
  EXPECT_EQ(body.scratch.growth_of(0), 1);
  EXPECT_DOUBLE_EQ(body.scratch.growth_of(1), std::cbrt(1.3));
  body.scratch.swell(body.laws, 0);
  EXPECT_EQ(body.scratch.growth_of(1), 1) << "it comes with the load";
}

TEST(SwellingStiffness, BoundGrowsWithTheStretch) {
  Specimen body = grown({.poisson_ratio = 0.49}, 0.728, 1);
  body.force(body.linear(0.2 * Eigen::Matrix3d::Identity()));
  const std::vector<double> bound = stiffness_bound(body.points, body.laws, body.scratch);
  Specimen plain = grown({.poisson_ratio = 0.49}, 0, 1);
  plain.force(plain.rest());
  const std::vector<double> rest = stiffness_bound(plain.points, plain.laws, plain.scratch);
  for (std::size_t a = 0; a < bound.size(); ++a) {
    EXPECT_NEAR(bound[a], 1.2 * rest[a], 1e-9 * rest[a]);
  }
}

/// A cube on three planes of symmetry, free otherwise.
Model on_planes(double swelling) {
  Model model = box_model(test::box_cells(3, side), 4);
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    for (int axis = 0; axis < 3; ++axis) {
      if (model.cloud.positions(a, axis) < 1e-9) {
        model.conditions.displacement(a, axis) = 0;
      }
    }
  }
  model.materials[1].swelling = swelling;
  return model;
}

TEST(SwellingToRest, IsExactAndItsEnergiesBalance) {
  for (const double swelling : {-0.5, 0.05, 2.0}) {
    SolveOptions options;
    options.tolerance = 1e-9;
    const SolveResult result = solve(on_planes(swelling), options);
    ASSERT_TRUE(result.measures.converged) << swelling << ": " << result.failure;
    const Eigen::Matrix3d h = (std::cbrt(1 + swelling) - 1) * Eigen::Matrix3d::Identity();
    EXPECT_LE(difference_from(result.solution, h), 1e-8 * side) << swelling;
    double most = 0;
    for (const HistoryRow& row : result.history) {
      const double became = row.strain_energy + row.kinetic_energy + row.dissipated_energy;
      most = std::max(most, std::abs(row.external_work));
      if (row.step > 20) {
        // three times the volume in 500 steps: what the trapezoidal rule leaves of each is then more
        EXPECT_NEAR(row.external_work, became, (swelling > 1 ? 0.03 : 0.01) * most)
            << swelling << ", step " << row.step;
      }
    }
    EXPECT_GT(most, 0);
    EXPECT_NEAR(result.history.back().strain_energy, 0, 1e-9 * most);
  }
}

TEST(SwellingInTime, ComesWithTheCurveAndBalances) {
  Model model = on_planes(0.05);
  model.materials[1].poisson_ratio = 0.4;
  model.curve = LoadCurve({0, 1, 2}, {0, 1, 1}, LoadCurve::Join::smooth);
  const SolveResult result = solve(model, in_time(20));
  ASSERT_TRUE(result.failure.empty()) << result.failure;
  const Eigen::Matrix3d h = (std::cbrt(1.05) - 1) * Eigen::Matrix3d::Identity();
  EXPECT_LE(difference_from(result.solution, h), 0.02 * side * h(0, 0));
  const HistoryRow& end = result.history.back();
  EXPECT_GT(end.external_work, 0);
  EXPECT_NEAR(end.external_work, end.strain_energy + end.kinetic_energy + end.dissipated_energy,
              0.01 * end.external_work);
}

}  // namespace brainshift::solve::swelling_test
