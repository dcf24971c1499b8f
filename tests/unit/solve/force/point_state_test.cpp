// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "solve/force/internal_force.hpp"
#include "solve/interface/result.hpp"
#include "tests/unit/solve/material_cases.hpp"
#include "tests/unit/solve/specimen.hpp"

namespace brainshift::solve::point_state_test {

constexpr double side = 30;
const Material soft{.youngs_modulus = 3000, .poisson_ratio = 0.4}, stiff{.youngs_modulus = 9000, .poisson_ratio = 0.3};

/// A cube that is deformed evenly.
PointState state(const std::vector<Material>& materials, const Eigen::Vector3d& stretches) {
  Specimen body(test::irregular_box(5, side), test::box_cells(4, side), materials, {});
  const Eigen::Matrix3d f = stretches.asDiagonal();
  body.force(body.linear(f - Eigen::Matrix3d::Identity()));
  return point_state(body.points, body.laws, body.scratch);
}

TEST(PointState, AtRestIsNone) {
  const PointState rest = state({soft}, {1, 1, 1});
  EXPECT_NEAR(rest.strain_energy, 0, 1e-12);
  EXPECT_NEAR(rest.smallest_jacobian, 1, 1e-12);
  EXPECT_NEAR(rest.largest_stretch, 1, 1e-6);
  EXPECT_EQ(rest.compressed_share, 0);
}

TEST(PointState, OfAnEvenDeformationIsThatOfTheLaw) {
  const Eigen::Vector3d stretches(1.3, 0.8, 0.9);
  const PointState found = state({soft}, stretches);
  const double expected = energy(elastic_law(soft), stretches.asDiagonal()) * side * side * side;
  EXPECT_NEAR(found.strain_energy, expected, 1e-9 * expected);
  EXPECT_NEAR(found.smallest_jacobian, stretches.prod(), 1e-10);
  EXPECT_NEAR(found.largest_stretch, 1.3, 1e-7);
}

TEST(PointState, AddsUpTheEnergiesOfTwoMaterials) {
  const Eigen::Vector3d stretches(1.2, 0.9, 1);
  const double both = state({soft, stiff}, stretches).strain_energy;
  const double of_soft = state({soft}, stretches).strain_energy, of_stiff = state({stiff}, stretches).strain_energy;
  // the second has the points beyond 0.62 of the side: of the columns of points the last three of eight
  EXPECT_NEAR(both, 5.0 / 8 * of_soft + 3.0 / 8 * of_stiff, 1e-9 * both);
}

TEST(PointState, CountsVolumeThatIsPressedUntilItsFacesCrease) {
  EXPECT_NEAR(state({soft}, {crease_stretch - 0.01, 1.2, 1.2}).compressed_share, 1, 1e-12);
  EXPECT_EQ(state({soft}, {crease_stretch + 0.01, 1.2, 1.2}).compressed_share, 0);
}

}  // namespace brainshift::solve::point_state_test
