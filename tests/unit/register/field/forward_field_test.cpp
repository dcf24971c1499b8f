// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/forward_field.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>

#include "register/registration.hpp"
#include "register/warp/warp.hpp"
#include "tests/unit/register/builders.hpp"

namespace brainshift::registration::forward_field_test {

using namespace builders;

constexpr double rounding = 2.2e-4;  // of the stored displacement: half of 1/4096 mm in each component

TEST(ForwardField, IsExactInTheBrainForALinearDisplacement) {
  Eigen::Matrix3d slope;
  slope << 0.02, -0.01, 0.03, 0.01, -0.04, 0.02, -0.02, 0.01, 0.05;
  const auto linear = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return slope * (x - centre) + Eigen::Vector3d(1, -2, 0.5);
  };
  for (const Basis basis : {Basis::linear, Basis::modified_quadratic}) {
    RegisterInput input = head(linear);
    input.solution.shape.basis = basis;
    const Registration result = register_images(input, {});
    double largest = 0;
    for_each_voxel(input.t1.geometry, [&](const Eigen::Vector3d& x, std::size_t v) {
      if ((x - centre).norm() < 0.98 * radius) {
        largest = std::max(largest, (at(result.forward, v) - linear(x)).norm());
      }
    });
    EXPECT_LT(largest, rounding);
    // At the surface a neighbour may lie beyond the reach of the shape functions.
    EXPECT_NEAR(result.measures.jacobian_min, (Eigen::Matrix3d::Identity() + slope).determinant(), 0.02);
    EXPECT_NEAR(result.measures.jacobian_max, (Eigen::Matrix3d::Identity() + slope).determinant(), 0.02);
  }
}

TEST(ForwardField, MovesTheNodesAsTheSolverDid) {
  const RegisterInput input = head(sinking);
  const Registration result = register_images(input, {});
  // Trilinear interpolation, h² u'' / 8 summed over the axes, comes to 0.03 mm; the rest is at the surface, where the
  // slope of the displacement ends within the voxel.
  EXPECT_LT(result.measures.fit_error, 0.1);
  const Points moved = move_points(result.forward, input.solution.positions);
  EXPECT_NEAR((moved - input.solution.positions - input.solution.displacement).rowwise().norm().maxCoeff(),
              result.measures.fit_error, 1e-12);
}

TEST(ForwardField, FadesToZeroAtTheStatedDistanceAndNotBefore) {
  const auto push = [](const Eigen::Vector3d&) { return Eigen::Vector3d(0, 0, 4); };
  RegisterOptions options;
  options.fade = 12;
  const RegisterInput input = head(push);
  const Registration result = register_images(input, options);
  const double flat = 0.3;  // mm by which the triangles lie inside the ball
  for_each_voxel(input.t1.geometry, [&](const Eigen::Vector3d& x, std::size_t v) {
    const double outside = (x - centre).norm() - radius, moved = at(result.forward, v).norm();
    if (outside > options.fade) {
      ASSERT_EQ(moved, 0) << outside;
    } else if (outside < options.fade - 2 - flat) {
      ASSERT_GT(moved, 0) << outside;
    }
    if (outside < 0) {
      ASSERT_NEAR(moved, 4, rounding);
    }
  });
}

TEST(ForwardField, HasNoJumpAnywhere) {
  const RegisterInput input = head(sinking);
  const VectorImage& field = register_images(input, {}).forward;
  const ImageGeometry& g = field.geometry;
  double steepest = 0;
  for (int k = 0; k < g.size.z(); ++k) {
    for (int j = 0; j < g.size.y(); ++j) {
      for (int i = 0; i + 1 < g.size.x(); ++i) {
        const double jump = (at(field, g.offset(i, j, k)) - at(field, g.offset(i + 1, j, k))).norm();
        steepest = std::max(steepest, jump / g.spacing.x());
      }
    }
  }
  EXPECT_LT(steepest, 8 * 1.25 / (20 - g.spacing.norm()) + 8 / 18.0 * std::exp(-0.5));  // the ramp's slope and its own
}

TEST(ForwardField, DoesNotFoldAtEightMillimetresInAnyDirection) {
  for (const double amount : {-8.0, 8.0}) {
    const Registration result =
        register_images(head([&](const Eigen::Vector3d& x) -> Eigen::Vector3d { return amount / 8 * sinking(x); }), {});
    EXPECT_GT(result.measures.field_jacobian_min, 0.2);
    EXPECT_EQ(result.measures.folded_voxels, 0U);
    EXPECT_EQ(result.measures.not_inverted, 0U);
    EXPECT_NEAR(result.measures.largest_displacement, 8, 0.2);
  }
}

TEST(ForwardField, ReportsThatItFolds) {
  RegisterOptions options;
  options.fade = 8;
  const Registration result =
      register_images(head([](const Eigen::Vector3d& x) -> Eigen::Vector3d { return -2 * sinking(x); }), options);
  EXPECT_LT(result.measures.field_jacobian_min, 0);
  EXPECT_GT(result.measures.folded_voxels, 0U);
  EXPECT_GT(result.measures.jacobian_min, 0);  // the brain itself does not
}

TEST(ForwardField, StaysContinuousBetweenTwoPartsOfTheBrainThatPart) {
  // Two balls as one surface: half-way between them the nearest part of the surface changes.
  const Eigen::Vector3d apart(17, 0, 0);
  RegisterInput input =
      head([&](const Eigen::Vector3d& x) { return Eigen::Vector3d(0, 0, x.x() > centre.x() ? 3 : -3); });
  Surface left = ball(centre - apart, 12), right = ball(centre + apart, 12);
  const Eigen::Index vertices = left.vertices.rows(), triangles = left.triangles.rows();
  input.brain.vertices.resize(2 * vertices, 3);
  input.brain.vertices << left.vertices, right.vertices;
  input.brain.triangles.resize(2 * triangles, 3);
  input.brain.triangles << left.triangles, right.triangles.array() + static_cast<std::int32_t>(vertices);
  input.solution = at_nodes(input.solution, [&](const Eigen::Vector3d& x) {
    return std::min((x - centre + apart).norm(), (x - centre - apart).norm()) <= 13;
  });
  const VectorImage& field = register_images(input, {}).forward;
  const ImageGeometry& g = field.geometry;
  double largest = 0;
  for (int i = 0; i + 1 < g.size.x(); ++i) {
    const int j = g.size.y() / 2, k = g.size.z() / 2;
    largest = std::max(largest, (at(field, g.offset(i, j, k)) - at(field, g.offset(i + 1, j, k))).norm());
  }
  EXPECT_LT(largest, 3.0);  // of the 6 mm between the two
}

}  // namespace brainshift::registration::forward_field_test
