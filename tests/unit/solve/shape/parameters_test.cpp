// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <stdexcept>

#include "solve/shape/shape_functions.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::parameters_test {

constexpr double side = 60;

class ParametersOfEveryBasis : public testing::TestWithParam<Basis> {};
INSTANTIATE_TEST_SUITE_P(Bases, ParametersOfEveryBasis,
                         testing::Values(Basis::linear, Basis::quadratic, Basis::modified_quadratic));

TEST_P(ParametersOfEveryBasis, ComeBackFromTheDisplacement) {
  const NodeCloud cloud = test::irregular_box(9, side);
  const ShapeFunctions shape(cloud.positions, cloud.spacing, {.basis = GetParam()});
  const Points parameters = test::random_points(static_cast<int>(cloud.positions.rows()), 5);
  const Points displacement = shape.interpolate(cloud.positions, parameters);
  const Points found = parameters_from_displacement(shape, cloud.positions, displacement);
  EXPECT_LE((shape.interpolate(cloud.positions, found) - displacement).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LE((found - parameters).cwiseAbs().maxCoeff(), 1e-4);
}

TEST_P(ParametersOfEveryBasis, ComeBackFromTheDisplacementInThePlane) {
  const NodeCloud cloud = test::irregular_rectangle(13, 11, side, side);
  const ShapeFunctions shape(cloud.positions, cloud.spacing, {.basis = GetParam(), .planar = true});
  Points parameters = test::random_points(static_cast<int>(cloud.positions.rows()), 5);
  parameters.col(2).setZero();
  const Points displacement = shape.interpolate(cloud.positions, parameters);
  const Points found = parameters_from_displacement(shape, cloud.positions, displacement);
  EXPECT_LE((shape.interpolate(cloud.positions, found) - displacement).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_TRUE((found.col(2).array() == 0).all());
}

TEST_P(ParametersOfEveryBasis, OfALinearFieldAreItsValues) {
  const NodeCloud cloud = test::irregular_box(6, side);
  const ShapeFunctions shape(cloud.positions, cloud.spacing, {.basis = GetParam()});
  const Eigen::Matrix3d h = (Eigen::Matrix3d() << 0.1, 0.2, 0, -0.1, 0.3, 0.1, 0, 0.2, -0.1).finished();
  const Points linear = cloud.positions * h.transpose();
  EXPECT_LE((parameters_from_displacement(shape, cloud.positions, linear) - linear).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(Parameters, OfADisplacementThatIsNotFiniteAreRefused) {
  const NodeCloud cloud = test::irregular_box(4, side);
  const ShapeFunctions shape(cloud.positions, cloud.spacing, {.basis = Basis::linear});
  Points displacement = cloud.positions;
  displacement(5, 1) = std::nan("");
  EXPECT_THROW(parameters_from_displacement(shape, cloud.positions, displacement), std::runtime_error);
}

}  // namespace brainshift::solve::parameters_test
