// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/fluid_force.hpp"

#include <gtest/gtest.h>

#include "solve/quadrature/cell_points.hpp"
#include "solve/shape/shape_functions.hpp"
#include "tests/unit/solve/models.hpp"
#include "tests/unit/solve/specimen.hpp"

namespace brainshift::solve::fluid_force_test {

constexpr double side = 60;
constexpr double newton = 1e-6;  // µN to N
const Eigen::Vector3d down(0, -9.81, 0);

struct Cube {
  NodeCloud cloud = test::irregular_box(6, side);
  BackgroundCells cells = test::box_cells(7, side);
  IntegrationPoints points = integration_points(cells, 8, nullptr, {1});
  ShapeRows rows = ShapeFunctions(cloud.positions, cloud.spacing, {}).evaluate(points.positions, true);

  NodalVectors force(const DrainedFluid& fluid, const std::map<std::int32_t, Material>& materials) const {
    NodalVectors total(4 * cloud.size(), 0.0);
    add_fluid_force(fluid, materials, points, extents_along(fluid.gravity.normalized(), cells, points), rows, total);
    return total;
  }
};

DrainedFluid drained_to(double height) {
  return {.gravity = down, .gravity_of_image = down, .level = -height, .density = 1007};
}

TEST(FluidForce, IsTheWeightOfTheFluidThatHeldWhatIsAboveTheLevel) {
  const Cube cube;
  for (const double height : {59.0, 37.3, 20.0, 4.1, 0.0, -5.0}) {
    const double volume = side * side * std::min(side, side - height);
    const Eigen::Vector3d weight = 1007e-9 * volume * down;
    const Eigen::Vector3d total = newton * resultant(cube.force(drained_to(height), {{1, {}}}));
    EXPECT_LE((total - weight).norm(), 1e-3 * weight.norm()) << height;
  }
}

/// As where integration splits each cell once.
TEST(FluidForce, IsTheSameOfPointsInTheMiddleOfTheirOctants) {
  Cube cube;
  for (std::size_t p = 0; p < cube.points.size(); ++p) {
    auto x = cube.points.positions.row(static_cast<Eigen::Index>(p));
    const Eigen::RowVector3d middle = (side / 7 * ((x / (side / 7)).array().floor() + 0.5)).matrix();
    x = middle + std::sqrt(3) / 2 * (x - middle);
  }
  cube.rows = ShapeFunctions(cube.cloud.positions, cube.cloud.spacing, {}).evaluate(cube.points.positions, true);
  for (const double height : {37.3, 4.1}) {
    const Eigen::Vector3d weight = 1007e-9 * side * side * (side - height) * down;
    const Eigen::Vector3d total = newton * resultant(cube.force(drained_to(height), {{1, {}}}));
    EXPECT_LE((total - weight).norm(), 1e-3 * weight.norm()) << height;
  }
}

TEST(FluidForce, IsNoneInARoomThatDrains) {
  const Cube cube;
  EXPECT_EQ(largest(cube.force(drained_to(10), {{1, {.room = Room::drained}}})), 0);
}

TEST(FluidForce, OfAFullRoomActsOnItsWallAlone) {
  Cube cube;
  constexpr double low = 12, high = 48;
  for (std::size_t p = 0; p < cube.points.size(); ++p) {
    const Eigen::RowVector3d x = cube.points.positions.row(static_cast<Eigen::Index>(p));
    cube.points.label[p] = x.minCoeff() > low && x.maxCoeff() < high ? 2 : 1;
  }
  const std::map<std::int32_t, Material> full = {{1, {}}, {2, {.room = Room::full}}}, drained = [] {
    return std::map<std::int32_t, Material>{{1, {}}, {2, {.room = Room::drained}}};
  }();
  const NodalVectors with = cube.force(drained_to(0), full), without = cube.force(drained_to(0), drained);
  double inside = 0, all = 0, room = 0;
  for (std::size_t p = 0; p < cube.points.size(); ++p) {
    room += cube.points.label[p] == 2 ? cube.points.volume[p] : 0;
  }
  for (std::size_t a = 0; a < cube.cloud.size(); ++a) {
    const Eigen::RowVector3d x = cube.cloud.positions.row(static_cast<Eigen::Index>(a));
    const double f = (at(with, a) - at(without, a)).norm();
    all = std::max(all, f);
    inside = std::max(inside, x.minCoeff() > 26 && x.maxCoeff() < 34 ? f : 0.0);
  }
  EXPECT_GT(all, 0);
  EXPECT_LT(inside, 0.2 * all) << "away from the wall pressure and weight of the fluid are in balance";
  const Eigen::Vector3d carried = newton * (resultant(with) - resultant(without));
  EXPECT_LE((carried - 1007e-9 * room * down).norm(), 1e-9 * room) << "its wall carries its weight";
}

/// Sideways the suction of each layer pulls at the walls: by its height above the level, over the cube's width.
TEST(FluidForce, OfAFullRoomSucksByTheHeightAboveTheLevelThatPartsIt) {
  const Cube cube;
  constexpr double height = 37.3;
  const NodalVectors force = cube.force(drained_to(height), {{1, {.room = Room::full}}});
  double virial = 0;
  for (std::size_t a = 0; a < cube.cloud.size(); ++a) {
    virial += newton * at(force, a)[0] * cube.cloud.positions(static_cast<Eigen::Index>(a), 0);
  }
  const double expected = -1007e-9 * down.norm() * side * side * std::pow(side - height, 2) / 2;
  EXPECT_NEAR(virial / expected, 1, 2e-3);
}

TEST(FluidForce, OfATurnedPatientIsWhatTheTissueWeighsInTheFluid) {
  const Cube cube;
  DrainedFluid fluid = drained_to(100);
  fluid.gravity_of_image = {9.81, 0, 0};
  const Eigen::Vector3d expected = 33e-9 * std::pow(side, 3) * (down - fluid.gravity_of_image);
  const Eigen::Vector3d total = newton * resultant(cube.force(fluid, {{1, {.density = 1040}}}));
  EXPECT_LE((total - expected).norm(), 1e-6 * expected.norm());
}

TEST(FluidLevel, CountsFromTheTop) {
  Points points(3, 3);
  points << 0, 10, 0, 1, -30, 2, 5, 50, 1;
  EXPECT_DOUBLE_EQ(highest(down, points), -50);
  EXPECT_DOUBLE_EQ(drained_level(down, 0.25, points), -30);
  EXPECT_DOUBLE_EQ(drained_level({0, 2, 0}, 0.25, points), -10);
}

TEST(DrainedBody, DoesNotMoveWhileItIsCovered) {
  Model model = uniaxial(1, 5);
  model.fluid = DrainedFluid{.gravity = {0, 0, -9.81}, .gravity_of_image = {0, 0, -9.81}, .level = -side};
  const SolveResult result = solve(model, {});
  ASSERT_TRUE(result.measures.converged) << result.failure;
  EXPECT_LE(result.solution.displacement.cwiseAbs().maxCoeff(), 1e-6);
}

TEST(DrainedBody, SinksWithTheCurveInTime) {
  Model model = stretched(1, 1, 3);
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if (model.cloud.positions(a, 2) > side - 1e-9) {
      model.conditions.displacement(a, 2) = std::nan("");
    }
  }
  model.fluid = DrainedFluid{.gravity = {0, 0, -9.81}, .gravity_of_image = {0, 0, -9.81}, .level = -0.4 * side};
  const SolveResult to_rest = solve(model, {.shape = in_time().shape});
  const SolveResult in_steps = solve(model, in_time(30));
  ASSERT_TRUE(in_steps.failure.empty()) << in_steps.failure;
  const double sunk = to_rest.solution.displacement.cwiseAbs().maxCoeff();
  EXPECT_GT(sunk, 0.5);
  EXPECT_LE((to_rest.solution.displacement - in_steps.solution.displacement).cwiseAbs().maxCoeff(), 0.05 * sunk);
  const HistoryRow& end = in_steps.history.back();
  EXPECT_NEAR(end.external_work, end.strain_energy + end.kinetic_energy + end.dissipated_energy,
              0.01 * end.external_work);
}

}  // namespace brainshift::solve::fluid_force_test
