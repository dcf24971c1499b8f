// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/craniotomy_load.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::solve::simulated_craniotomy_test {

const Eigen::Vector3d middle(200, -40, 15);
const double radius = 75;

TEST(SimulatedCraniotomy, SinksTheSphereByItsDepthAmidTheOpeningAndByLittleAtTheRim) {
  const Surface brain = test::sphere(middle, radius, 5);
  const Eigen::Vector3d axis = Eigen::Vector3d(0.3, -0.5, 0.8).normalized();
  const SimulatedCraniotomy opening{.centre = middle + 1.3 * radius * axis, .radius = 28, .depth = 8};
  const CraniotomyLoad load = simulated_craniotomy(brain, opening);
  double inside = 0;
  for (Eigen::Index v = 0; v < brain.vertices.rows(); ++v) {
    const Eigen::Vector3d x = brain.vertices.row(v).transpose() - middle;
    inside += x.dot(axis) > 0 && x.cross(axis).norm() <= 28;
  }
  EXPECT_NEAR(static_cast<double>(load.positions.rows()), inside, 0.02 * inside);
  for (Eigen::Index p = 0; p < load.positions.rows(); ++p) {
    const Eigen::Vector3d x = load.positions.row(p).transpose() - middle;
    const Eigen::Vector3d u = load.displacement.row(p);
    const double r = x.cross(axis).norm();
    EXPECT_LT(u.normalized().cross(axis).norm(), 0.02) << "along the mean normal";
    EXPECT_LT(u.dot(axis), 0) << "inward";
    EXPECT_LE(u.norm(), 8 + 1e-12);
    if (r < 2) {
      EXPECT_GT(u.norm(), 7.8);
    }
    if (r > 26) {
      EXPECT_LT(u.norm(), 1.0);
    }
  }
}

TEST(SimulatedCraniotomy, LeavesTheFarSideAloneEvenThroughAThinBrain) {
  Surface plate = test::sphere(Eigen::Vector3d::Zero(), 1, 5);
  plate.vertices *= Eigen::Vector3d(80, 80, 6).asDiagonal();
  const CraniotomyLoad load = simulated_craniotomy(plate, {.centre = {0, 0, 30}, .radius = 25, .depth = 5});
  EXPECT_GT(load.positions.rows(), 50);
  EXPECT_GT(load.positions.col(2).minCoeff(), 0);
  EXPECT_LT(load.displacement.col(2).maxCoeff(), 0);
}

TEST(SimulatedCraniotomy, IsReadBackAsALoadOfTheSurfaceItWasMadeOn) {
  const Surface brain = test::sphere(middle, radius, 4);
  const auto vertices = static_cast<std::size_t>(brain.vertices.rows());
  const NodeCloud cloud{.positions = brain.vertices,
                        .spacing = std::vector<double>(vertices, 5.0),
                        .on_surface = std::vector<std::uint8_t>(vertices, 1)};
  const CraniotomyLoad load = simulated_craniotomy(brain, {.centre = middle + Eigen::Vector3d(0, 0, radius)});
  const Points prescribed = prescribed_on_surface_nodes(cloud, load);
  EXPECT_NEAR((-prescribed.col(2)).array().isNaN().select(0, -prescribed.col(2)).maxCoeff(), 8, 0.1);
  const auto loaded = prescribed.rows() - prescribed.col(0).array().isNaN().count();
  EXPECT_NEAR(static_cast<double>(loaded), static_cast<double>(load.positions.rows()), 10);
}

TEST(SimulatedCraniotomy, RefusesWhatCannotBeOpened) {
  const Surface brain = test::sphere(middle, radius, 3);
  EXPECT_THROW(simulated_craniotomy(brain, {.centre = middle, .radius = 0}), std::invalid_argument);
  EXPECT_THROW(simulated_craniotomy(brain, {.centre = middle, .depth = -1}), std::invalid_argument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(simulated_craniotomy(brain, {.centre = middle, .radius = nan}), std::invalid_argument);
  EXPECT_THROW(simulated_craniotomy(brain, {.centre = {nan, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(simulated_craniotomy(brain, {.centre = middle, .radius = 0.5}), std::invalid_argument);
  EXPECT_THROW(simulated_craniotomy(Surface{}, {}), std::invalid_argument);
}

}  // namespace brainshift::solve::simulated_craniotomy_test
