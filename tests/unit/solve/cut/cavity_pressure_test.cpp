// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/cavity_pressure.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "solve/quadrature/cell_points.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::cavity_pressure_test {

constexpr double side = 40, pressure = 100;  // mm, Pa
constexpr double newton = 1e-6;              // Pa mm² to N

struct Cube {
  NodeCloud cloud = test::irregular_box(9, side, 0.1);
  IntegrationPoints points = integration_points(test::box_cells(16, side), 1, nullptr, {1});
  ShapeRows rows = ShapeFunctions(cloud.positions, cloud.spacing, {}).evaluate(points.positions, true);

  Points force(const std::function<bool(const Eigen::RowVector3d&)>& is_cavity) const {
    std::vector<std::uint8_t> removed;
    for (const auto& x : points.positions.rowwise()) {
      removed.push_back(is_cavity(x) ? 1 : 0);
    }
    return cavity_force(points, removed, rows, cloud.positions.rows(), pressure);
  }
};

bool in_core(const Eigen::RowVector3d& x) {
  return (x.array() - side / 2).abs().maxCoeff() < side / 4;
}

TEST(CavityPressure, IsNothingWhereNothingOrEverythingIsTakenOut) {
  const Cube cube;
  EXPECT_TRUE(cube.force([](const auto&) { return false; }).isZero(0));
  EXPECT_LE(cube.force([](const auto&) { return true; }).cwiseAbs().maxCoeff(), 1e-12);
}

/// The wall of what is left is that of the cavity, seen from its other side.
TEST(CavityPressure, ChangesItsSignWhereCavityAndTissueChangePlaces) {
  const Cube cube;
  const Points in = cube.force(in_core), out = cube.force([](const auto&x) { return !in_core(x); });
  EXPECT_LE((in + out).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT(in.cwiseAbs().maxCoeff(), 1e-4);
}

/// ∫_wall n dA is 0, ∫_wall X ⊗ n dA the volume times 1.
TEST(CavityPressure, OfAClosedCavityPushesAllWaysAlike) {
  const Cube cube;
  const Points force = cube.force(in_core);
  const double area = 6 * side * side / 4, volume = side * side * side / 8;
  EXPECT_LE(force.colwise().sum().norm(), 2e-3 * pressure * area * newton);
  const Eigen::Matrix3d moment = force.transpose() * cube.cloud.positions / (pressure * volume * newton);
  EXPECT_LE((moment - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 0.02) << moment;
}

TEST(CavityPressure, OfAnOpenCavityPushesOnItsWallAlone) {
  const Cube cube;
  const Points force = cube.force([](const auto& x) { return x[2] > side / 2; });
  const double whole = pressure * side * side * newton;
  EXPECT_NEAR(force.col(2).sum(), -whole, 0.02 * whole) << "out of the cavity";
  EXPECT_LE(force.leftCols<2>().colwise().sum().norm(), 0.02 * whole);
}

}  // namespace brainshift::solve::cavity_pressure_test
