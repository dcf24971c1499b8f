// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/walled_resection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "discretise/discretise.hpp"
#include "solve/body/check_model.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/shapes.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/models.hpp"
#include "tests/unit/solve/move_surface.hpp"

namespace brainshift::solve::walled_resection_test {

const Eigen::Vector3d origin = Eigen::Vector3d::Zero();

/// A body that what lies within the wall will be taken out of. Its cells know of the wall.
Model with_wall(const Surface& body, const Surface& wall, std::size_t nodes) {
  discretise::DiscretiseOptions options;
  options.nodes = nodes;
  options.resected = discretise::ResectedTissue{wall, {2}};
  discretise::Discretisation parts = discretise::discretise(body, nullptr, options);
  Model model;
  model.cloud = std::move(parts.cloud);
  model.cells = std::move(parts.cells);
  model.boundary = body;
  model.conditions = test::all_free(model.cloud);
  model.materials[1] = {.youngs_modulus = 3000, .poisson_ratio = 0.45};
  model.resection = Resection{.labels = {2}, .wall = wall};
  return model;
}

TEST(WalledResection, TakesOutWhatLiesWithin) {
  const Surface ball = test::sphere(origin, 20, 4), wall = test::sphere(origin, 8, 4);
  const Model model = with_wall(ball, wall, 1500);
  const Resected resected = resect_within_wall(model);
  const ResectionMeasures& m = resected.measures;
  EXPECT_NEAR(m.removed_volume, volume(wall), 1e-3 * volume(wall));
  EXPECT_NEAR(*m.volume, volume(wall), 1e-9 * volume(wall));
  EXPECT_NEAR(m.wall_area, area(wall), 1e-9 * area(wall));
  const NodeCloud& left = resected.rest.cloud;
  EXPECT_EQ(left.size() + m.removed_nodes, model.cloud.size());
  std::size_t at_wall = 0;
  for (std::size_t a = 0; a < left.size(); ++a) {
    const double r = left.positions.row(static_cast<Eigen::Index>(a)).norm();
    EXPECT_GT(r, 7.9);
    at_wall += left.on_surface[a] != 0 && r < 8.1 ? 1 : 0;
  }
  EXPECT_EQ(at_wall, m.wall_nodes);
  // As dense as on the body's surface.
  const auto outside = static_cast<double>(std::ranges::count(model.cloud.on_surface, 1));
  EXPECT_NEAR(static_cast<double>(at_wall) / area(wall) / (outside / area(ball)), 1, 0.1);
}

/// A body without stress but for an even pressure on all that bounds it: a homogeneous state.
TEST(WalledResection, LeavesAHollowBallThatAnEvenPressureShrinksEvenly) {
  const Surface ball = test::sphere(origin, 20, 4), wall = test::sphere(origin, 8, 4);
  Model model = with_wall(ball, wall, 1000);
  model.materials[1].law = Law::linear_elastic;
  // Pressed by the outer surface's displacement, with the same pressure in the cavity, the strain is the same
  // everywhere.
  constexpr double strain = -0.01;
  test::move_surface(model, strain * Eigen::Matrix3d::Identity());
  model.resection->pressure = -3 * bulk_modulus(model.materials[1]) * strain;
  SolveOptions options;
  options.tolerance = 1e-4;
  const SolveResult result = solve(model, options);
  ASSERT_TRUE(result.measures.converged) << result.failure;
  const Points expected = strain * result.solution.positions;
  const double spacing = std::cbrt(volume(ball) / static_cast<double>(model.cloud.size()));
  EXPECT_LT((result.solution.displacement - expected).rowwise().norm().maxCoeff(), 0.01 * spacing);
  EXPECT_NEAR(*result.measures.resection->volume / volume(wall), std::pow(1 + strain, 3), 1e-3);
  EXPECT_EQ(result.solution.estimated_error.size(), result.measures.nodes);
  EXPECT_LT(result.measures.estimated_error_95.value(), 0.02 * spacing) << "a coarse cloud has that state, too";
}

/// Two plates, farther apart than a support is wide, pressed together: they carry what one block of both would.
class Plates : public ::testing::Test {
 protected:
  static constexpr double side = 40, gap = 10, pressed = 12;

  static Model plates() {
    Model model = with_wall(test::box(origin, {side, side, side}),
                            test::box({-5, -5, (side - gap) / 2}, {side + 5, side + 5, (side + gap) / 2}), 1000);
    for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
      const Eigen::RowVector3d x = model.cloud.positions.row(a);
      auto prescribed = model.conditions.displacement.row(a);
      constexpr double hair = 1e-3;
      if (x[2] < hair || x[2] > side - hair) {
        prescribed[2] = x[2] < hair ? 0 : -pressed;
      }
      for (const int axis : {0, 1}) {
        if (x[axis] < hair) {
          prescribed[axis] = 0;
        }
      }
    }
    return model;
  }
};

TEST_F(Plates, MeetAndCarryLoad) {
  const Model model = plates();
  const SolveResult result = solve(model, {});
  ASSERT_TRUE(result.measures.converged) << result.failure;
  const ResectionMeasures& m = *result.measures.resection;
  EXPECT_NEAR(m.removed_volume, side * side * gap, 0.005 * side * side * gap);
  EXPECT_FALSE(m.volume) << "it lies open";
  const double spacing = result.solution.spacing.front();
  EXPECT_LT(m.touch.largest_overlap, 0.1 * spacing);
  EXPECT_GT(m.touch.touching_nodes, 0.6 * static_cast<double>(m.wall_nodes));
  const double stretch = 1 - (pressed - gap) / (side - gap);
  const double force = uniaxial_answer(model.materials.at(1), stretch).first * side * side * 1e-6;
  EXPECT_NEAR(result.history.back().reaction.z() / force, 1, 0.03);
}

TEST_F(Plates, OpenAgain) {
  Model model = plates();
  model.curve = LoadCurve({0, 1, 2}, {0, 1, 0}, LoadCurve::Join::smooth);
  const SolveResult result = solve(model, {});
  ASSERT_TRUE(result.measures.converged) << result.failure;
  EXPECT_EQ(result.measures.resection->touch.touching_nodes, 0U);
  EXPECT_LT(result.measures.largest_displacement, 0.02 * pressed);
}

/// A dry cavity in a ball that lies in fluid: what is around it is pressed into it.
TEST(WalledResection, ADryCavityInFluidIsPressedFlatAndNotTurnedInsideOut) {
  const Surface ball = test::sphere(origin, 30, 4), wall = test::sphere(origin, 8, 4);
  Model model = with_wall(ball, wall, 800);
  model.materials[1].youngs_modulus = 200;
  model.fluid = DrainedFluid{.gravity = {0, 0, -9.81}, .gravity_of_image = {0, 0, -9.81}, .level = -40};
  model.resection->fluid_level = 100;
  test::move_surface(model, Eigen::Matrix3d::Zero());
  const SolveResult result = solve(model, {});
  ASSERT_TRUE(result.measures.converged) << result.failure;
  const ResectionMeasures& m = *result.measures.resection;
  const double spacing = std::cbrt(volume(ball) / static_cast<double>(model.cloud.size()));
  EXPECT_LT(m.touch.largest_overlap, 0.1 * spacing);
  EXPECT_GT(m.touch.touching_nodes, m.wall_nodes / 5) << "its walls meet";
  EXPECT_GT(*m.volume, 0);
  EXPECT_LT(*m.volume, 0.05 * volume(wall));
}

std::string fault(const Model& model) {
  try {
    solve(model, {});
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(WalledResection, RefusesAWallThatTakesNothingOrAll) {
  Model model = with_wall(test::sphere(origin, 20, 3), test::sphere(origin, 8, 3), 300);
  model.conditions.displacement.resize(model.cloud.positions.rows(), 3);
  model.conditions.displacement.setConstant(std::numeric_limits<double>::quiet_NaN());
  Eigen::Index middle = 0;
  model.cloud.positions.rowwise().norm().minCoeff(&middle);
  model.conditions.displacement.row(middle).setZero();
  EXPECT_NE(fault(model).find("has a prescribed displacement, but lies in the tissue that is taken out"),
            std::string::npos);
  model.conditions = test::all_free(model.cloud);
  model.resection->wall = test::sphere({100, 0, 0}, 8, 2);
  EXPECT_NE(fault(model).find("encloses no background cell"), std::string::npos);
  model.resection->wall = test::sphere(origin, 30, 2);
  EXPECT_NE(fault(model).find("the whole body"), std::string::npos);
  model.resection = Resection{.labels = {2}, .fluid_level = 3, .wall = Surface()};
  EXPECT_NE(test::refusal([&] { check_model(model); }).find("nothing says which way gravity pulls it"),
            std::string::npos);
}

}  // namespace brainshift::solve::walled_resection_test
