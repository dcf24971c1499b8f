// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/wall_load.hpp"

#include <gtest/gtest.h>

#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::solve::wall_load_test {

constexpr double newton = 1e-6;
const Eigen::Vector3d centre(120, -40, 75);

Eigen::RowVector3d total(const PlacedForces& forces) {
  return forces.force.colwise().sum();
}

TEST(WallLoad, OfAnEvenPressureIsInBalance) {
  const Surface wall = test::sphere(centre, 10, 3);
  const PlacedForces forces = forces_on_wall(wall, 2, [](const Eigen::Vector3d&) { return 200; });
  const double whole = 200 * area(wall) * newton;
  EXPECT_LT(total(forces).norm(), 1e-12 * whole);
  EXPECT_NEAR(forces.force.rowwise().norm().sum(), whole, 1e-12 * whole);
  // ∫ n ⊗ x dA is the volume times 1.
  const Eigen::Matrix3d moment = forces.force.transpose() * forces.places / (200 * volume(wall) * newton);
  EXPECT_LT((moment - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-9);
}

/// Archimedes.
TEST(WallLoad, OfAFluidCarriesItsWeight) {
  Model model;
  model.fluid = DrainedFluid{.gravity = {0, 6, -8}, .level = -1e6, .density = 1007};
  const Surface wall = test::sphere(centre, 10, 3);
  model.resection = Resection{.labels = {2}, .fluid_level = 1e6, .wall = wall};
  EXPECT_TRUE(presses_on_wall(*model.resection));
  const auto dry = cavity_pressure(model);
  const Eigen::RowVector3d force = total(forces_on_wall(wall, 3, dry));
  // A dry cavity in a fluid is pushed up by the weight of the fluid that is missing: the wall is pulled inward.
  const Eigen::Vector3d lift = -1e-9 * 1007 * volume(wall) * model.fluid->gravity;
  EXPECT_LT((force.transpose() - lift).norm(), 1e-9 * lift.norm());
  const Eigen::Vector3d down(0, 0.6, -0.8);
  EXPECT_NEAR(dry(centre), -1e-3 * 1007 * 10 * (centre.dot(down) + 1e6), 1e-6);
}

TEST(WallLoad, IsTheDifferenceOfTwoLevels) {
  Model model;
  model.fluid = DrainedFluid{.gravity = {0, 0, -10}, .level = -70, .density = 1000};
  model.resection = Resection{.labels = {2}, .pressure = 5, .fluid_level = -50, .wall = Surface()};
  const auto pressure = cavity_pressure(model);
  const auto at_height = [&](double z) { return pressure({0, 0, z}); };
  EXPECT_NEAR(at_height(80), 5, 1e-12);        // above both
  EXPECT_NEAR(at_height(60), 5 - 100, 1e-12);  // 10 mm below that of the brain: it presses, nothing presses back
  EXPECT_NEAR(at_height(40), 5 + 100 - 300, 1e-12);
}

TEST(WallLoad, IsNoneWithoutAWallOrAPressure) {
  EXPECT_FALSE(presses_on_wall({.labels = {2}, .pressure = 10}));
  EXPECT_FALSE(presses_on_wall({.labels = {2}, .wall = Surface()}));
  EXPECT_TRUE(presses_on_wall({.labels = {2}, .pressure = 10, .wall = Surface()}));
}

}  // namespace brainshift::solve::wall_load_test
