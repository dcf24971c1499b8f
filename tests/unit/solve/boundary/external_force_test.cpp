// SPDX-License-Identifier: GPL-3.0-or-later

#include "solve/boundary/external_force.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "solve/quadrature/cell_points.hpp"
#include "tests/unit/solve/specimen.hpp"

namespace brainshift::solve::external_force_test {

constexpr double side = 50;
constexpr double newton = 1e-6;  // µN to N

/// A cloud, or one in the plane, with its shape functions.
struct Scene {
  NodeCloud cloud;
  IntegrationPoints points;
  ShapeFunctions shape;

  explicit Scene(bool planar)
      : cloud(planar ? test::irregular_rectangle(7, 7, side, side) : test::irregular_box(6, side)),
        points(integration_points(planar ? test::rectangle_cells(9, 9, side, side) : test::box_cells(4, side),
                                  planar ? 4 : 8, nullptr, {1})),
        shape(cloud.positions, cloud.spacing, {.planar = planar}) {}

  NodalVectors zero() const { return NodalVectors(4 * cloud.size(), 0.0); }

  /// Σ X_a × f_a, N mm.
  Eigen::Vector3d moment(const NodalVectors& force) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t a = 0; a < cloud.size(); ++a) {
      const Eigen::Vector3d x = cloud.positions.row(static_cast<Eigen::Index>(a));
      sum += newton * x.cross(at(force, a).head<3>());
    }
    return sum;
  }
};

class ForceOnNodes : public testing::TestWithParam<bool> {
 protected:
  Scene scene{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Dimensions, ForceOnNodes, testing::Bool(),
                         [](const auto& tested) { return std::string(tested.param ? "Two" : "Three"); });

TEST_P(ForceOnNodes, AtANodeKeepsForceAndMoment) {
  const Eigen::Index nodes[] = {0, 24, 31};
  const Eigen::Vector3d push(0.2, -0.1, GetParam() ? 0 : 0.3);
  for (const Eigen::Index node : nodes) {
    Points force = Points::Zero(scene.cloud.positions.rows(), 3);
    force.row(node) = push;
    NodalVectors total = scene.zero();
    add_point_forces(force, scene.shape.evaluate(scene.cloud.positions, false), total);
    const Eigen::Vector3d x = scene.cloud.positions.row(node);
    EXPECT_LE((newton * resultant(total) - push).norm(), 1e-12);
    EXPECT_LE((scene.moment(total) - x.cross(push)).norm(), 1e-12 * side);
    EXPECT_LT(at(total, static_cast<std::size_t>(node)).norm() * newton, 0.999 * push.norm());  // spread, not set
  }
}

TEST_P(ForceOnNodes, OfGravityIsTheWeightAtTheCentre) {
  const Eigen::Vector3d weight_density(1e-6, -9.81e-6, GetParam() ? 0 : 3e-6);  // N/mm³
  NodalVectors total = scene.zero();
  add_body_force([&](const Eigen::Vector3d&, std::int32_t) { return weight_density; }, scene.points,
                 scene.shape.evaluate(scene.points.positions, false), total);
  const double volume = side * side * (GetParam() ? 1 : side);
  const Eigen::Vector3d centre = side / 2 * Eigen::Vector3d(1, 1, GetParam() ? 0 : 1);
  const Eigen::Vector3d weight = volume * weight_density;
  EXPECT_LE((newton * resultant(total) - weight).norm(), 1e-11 * weight.norm());
  EXPECT_LE((scene.moment(total) - centre.cross(weight)).norm(), 1e-11 * side * weight.norm());
}

TEST_P(ForceOnNodes, TakesPlaceAndLabelOfABodyForce) {
  for (std::size_t p = 0; p < scene.points.size(); ++p) {
    scene.points.label[p] = scene.points.positions(static_cast<Eigen::Index>(p), 0) < side / 2 ? 1 : 2;
  }
  NodalVectors total = scene.zero();
  const double along_y = 1e-6;
  add_body_force(
      [&](const Eigen::Vector3d& x, std::int32_t label) -> Eigen::Vector3d {
        return label == 2 ? Eigen::Vector3d(0, along_y * x.y(), 0) : Eigen::Vector3d::Zero();
      },
      scene.points, scene.shape.evaluate(scene.points.positions, false), total);
  double expected = 0;
  for (std::size_t p = 0; p < scene.points.size(); ++p) {
    const double y = scene.points.positions(static_cast<Eigen::Index>(p), 1);
    expected += scene.points.label[p] == 2 ? scene.points.volume[p] * along_y * y : 0;
  }
  EXPECT_GT(expected, 0);
  EXPECT_LE((newton * resultant(total) - Eigen::Vector3d(0, expected, 0)).norm(), 1e-11 * expected);
}

TEST_P(ForceOnNodes, AddsToWhatIsThere) {
  NodalVectors once = scene.zero();
  const ShapeRows rows = scene.shape.evaluate(scene.cloud.positions, false);
  const Points force = Points::Constant(scene.cloud.positions.rows(), 3, 0.5);
  add_point_forces(force, rows, once);
  NodalVectors twice = once;
  add_point_forces(force, rows, twice);
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_NEAR(twice[i], 2 * once[i], 1e-6);  // µN
  }
}

TEST(ExternalForce, InProportionIsThatOfTheFullLoadTimesTheFraction) {
  EXPECT_TRUE(ExternalForce(NodalVectors()).empty());
  const ExternalForce force(NodalVectors{2, 0, -4, 0});
  NodalVectors left(4, 0.0);
  force.subtract(0.25, left);
  EXPECT_EQ(left, (NodalVectors{-0.5, 0, 1, 0}));
  EXPECT_DOUBLE_EQ(force.work(0, 1, {0, 0, 0, 0}, {3, 0, 0, 0}), 3) << "half of it in the mean";
}

TEST(ExternalForce, OfATableIsJoinedByStraightLinesFromNothing) {
  const ExternalForce force(std::vector<NodalVectors>{{1, 0, 0, 0}, {4, 0, 0, 0}});
  const auto at_fraction = [&](double fraction) {
    NodalVectors left(4, 0.0);
    force.subtract(fraction, left);
    return -left[0];
  };
  EXPECT_DOUBLE_EQ(at_fraction(0), 0);
  EXPECT_DOUBLE_EQ(at_fraction(0.25), 0.5);
  EXPECT_DOUBLE_EQ(at_fraction(0.5), 1);
  EXPECT_DOUBLE_EQ(at_fraction(0.75), 2.5);
  EXPECT_DOUBLE_EQ(at_fraction(1), 4);
  EXPECT_DOUBLE_EQ(at_fraction(1.5), 7) << "on along the last line";
  EXPECT_DOUBLE_EQ(force.work(0.5, 1, {0, 0, 0, 0}, {2, 0, 0, 0}), 5);
}

}  // namespace brainshift::solve::external_force_test
