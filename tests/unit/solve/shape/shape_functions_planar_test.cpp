// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/shape/shape_functions.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "segmentation/geometry/neighbour_distance.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/unit/solve/completeness.hpp"

namespace brainshift::solve::shape_functions_planar_test {

using test::completeness_error;
using test::expect_derivatives_of_values;
using test::irregular_rectangle;

constexpr double width = 60, height = 40;

NodeCloud cloud_of_rectangle() {
  return irregular_rectangle(16, 11, width, height);
}

Points random_places(int count) {
  Points places = test::random_points(count, 1);
  places.array().rowwise() *= Eigen::RowVector3d(width, height, 0).array();
  return places;
}

class EveryPlanarBasis : public testing::TestWithParam<Basis> {
 protected:
  ShapeOptions options() const { return {.basis = GetParam(), .planar = true}; }
  ShapeFunctions shape_of(const NodeCloud& cloud) const { return {cloud.positions, cloud.spacing, options()}; }
};
INSTANTIATE_TEST_SUITE_P(Bases, EveryPlanarBasis,
                         testing::Values(Basis::linear, Basis::quadratic, Basis::modified_quadratic));

TEST_P(EveryPlanarBasis, IsAPartitionOfUnityAndLinearlyCompleteOnAnIrregularCloud) {
  EXPECT_LE(completeness_error(cloud_of_rectangle(), random_places(500), options()), 1e-10);
}

TEST_P(EveryPlanarBasis, IsCompleteTenMetresFromTheOriginAndInMetres) {
  NodeCloud cloud = cloud_of_rectangle();
  Points at = random_places(200);
  cloud.positions.rowwise() += Eigen::RowVector3d(1e4, -5e3, 0);
  at.rowwise() += Eigen::RowVector3d(1e4, -5e3, 0);
  EXPECT_LE(completeness_error(cloud, at, options()), 1e-9);
  const NodeCloud small = irregular_rectangle(16, 11, width * 1e-3, height * 1e-3);
  EXPECT_LE(completeness_error(small, random_places(200) * 1e-3, options()), 1e-10);
}

/// The nodes at a corner are farther from their six nearest than the others.
TEST_P(EveryPlanarBasis, IsCompleteAtTheCornersOfACloudWithoutAStatedSpacing) {
  NodeCloud cloud = irregular_rectangle(16, 11, width, height, 0.4);
  cloud.spacing = mean_neighbour_distance(nearest_neighbours(cloud.positions, 6));
  for (const double scale : {1.0, 0.03}) {
    EXPECT_LE(completeness_error(cloud, random_places(500) * scale, options()), 1e-10);
  }
}

TEST_P(EveryPlanarBasis, SeesNoChangeAlongZ) {
  const ShapeRows rows = shape_of(cloud_of_rectangle()).evaluate(random_places(200), true);
  for (std::size_t k = 0; k < rows.node.size(); ++k) {
    EXPECT_EQ(rows.derivative[3 * k + 2], 0.0);
  }
}

TEST_P(EveryPlanarBasis, HasTheDerivativesOfItsValues) {
  const NodeCloud cloud = cloud_of_rectangle();
  const ShapeFunctions shape = shape_of(cloud);
  const Points at = random_places(60);
  expect_derivatives_of_values(shape, cloud.positions, at, 2);
}

TEST_P(EveryPlanarBasis, TurnsWithTheCloud) {
  NodeCloud cloud = cloud_of_rectangle();
  const Points at = random_places(200);
  const ShapeRows before = shape_of(cloud).evaluate(at, true);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  cloud.positions = (cloud.positions * turn.transpose()).eval();
  const ShapeRows after = shape_of(cloud).evaluate(at * turn.transpose(), true);
  ASSERT_EQ(before.node, after.node);
  for (std::size_t k = 0; k < before.node.size(); ++k) {
    EXPECT_NEAR(before.value[k], after.value[k], 1e-9);
    const Eigen::Vector3d old(&before.derivative[3 * k]), turned(&after.derivative[3 * k]);
    EXPECT_LE((turn * old - turned).norm(), 1e-9);
  }
}

double quadratic_error(Basis basis) {
  const NodeCloud cloud = cloud_of_rectangle();
  const Points at = random_places(300);
  const auto field = [](const Points& x) {
    Points u(x.rows(), 3);
    u.col(0) = x.col(0).cwiseProduct(x.col(1)) / width;
    u.col(1) = x.col(1).cwiseAbs2() / width;
    u.col(2) = (x.col(0) - x.col(1)).cwiseAbs2() / width;
    return u;
  };
  const ShapeFunctions shape(cloud.positions, cloud.spacing, {.basis = basis, .planar = true});
  return (shape.interpolate(at, field(cloud.positions)) - field(at)).cwiseAbs().maxCoeff();
}

TEST(PlanarShapeFunctions, ReproduceQuadraticFieldsWithTheQuadraticBasis) {
  EXPECT_LE(quadratic_error(Basis::quadratic), 1e-9);
}

TEST(PlanarShapeFunctions, ReproduceQuadraticFieldsUpToThePenaltyWithTheModifiedBasis) {
  EXPECT_LE(quadratic_error(Basis::modified_quadratic), 1e-3);  // µ = 1e-7 over second moments of 1e-3, times 60 mm
  EXPECT_GE(quadratic_error(Basis::linear), 0.05);              // the test can tell
}

TEST(PlanarShapeFunctions, SeldomGrowASupportOfTheDefaultDilatation) {
  const NodeCloud cloud = irregular_rectangle(41, 25, width, height * 0.9);
  const Points at = random_places(5000).cwiseProduct(Eigen::RowVector3d(1, 0.9, 1).replicate(5000, 1));
  for (const Basis basis : {Basis::linear, Basis::quadratic, Basis::modified_quadratic}) {
    const ShapeFunctions shape(cloud.positions, cloud.spacing, {.basis = basis, .planar = true});
    const ShapeRows rows = shape.evaluate(at, false);
    const double seen = static_cast<double>(rows.node.size()) / static_cast<double>(rows.size());
    EXPECT_LE(rows.grown, 25U);
    EXPECT_GE(seen, basis == Basis::linear ? 8 : 12);
    EXPECT_LE(seen, basis == Basis::linear ? 12 : 20);
  }
}

/// Two rows of nodes: along y, no more than a line is determined.
NodeCloud two_lines() {
  return irregular_rectangle(12, 2, 11, 1);
}

TEST(PlanarShapeFunctions, OfTheModifiedBasisNeedNoMoreNodesThanLinearOnes) {
  Points at = test::random_points(50, 1);
  at.array().rowwise() *= Eigen::RowVector3d(11, 1, 0).array();
  const ShapeOptions linear{.basis = Basis::linear, .planar = true};
  const ShapeOptions modified{.basis = Basis::modified_quadratic, .planar = true};
  EXPECT_LE(completeness_error(two_lines(), at, linear), 1e-10);
  EXPECT_LE(completeness_error(two_lines(), at, modified), 1e-7);  // the penalty, 1e-7, is all that holds y²
  const NodeCloud cloud = two_lines();
  const ShapeFunctions quadratic(cloud.positions, cloud.spacing, {.basis = Basis::quadratic, .planar = true});
  EXPECT_THROW(quadratic.evaluate(at, false), std::invalid_argument);
}

TEST_P(EveryPlanarBasis, RefusesACloudOnOneLine) {
  NodeCloud cloud = irregular_rectangle(12, 2, 11, 1);
  cloud.positions.col(1) = 0.5 * cloud.positions.col(0);
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    cloud.positions.row(a).head<2>() *= 1 + 0.01 * static_cast<double>(a);  // none in the place of another
  }
  try {
    shape_of(cloud).evaluate(random_places(1), false);
    FAIL() << "the cloud was taken";
  } catch (const std::invalid_argument& fault) {
    EXPECT_NE(std::string(fault.what()).find("on one line"), std::string::npos) << fault.what();
  }
}

TEST_P(EveryPlanarBasis, AsksForAsManyNodesAsItHasToHave) {
  const int least = GetParam() == Basis::quadratic ? 6 : 3;
  NodeCloud cloud = irregular_rectangle(3, 2, 2, 1);
  cloud.positions.conservativeResize(least, 3);
  cloud.spacing.resize(static_cast<std::size_t>(least));
  EXPECT_NO_THROW(shape_of(cloud));
  cloud.positions.conservativeResize(least - 1, 3);
  cloud.spacing.pop_back();
  EXPECT_THROW(shape_of(cloud), std::invalid_argument);
}

TEST_P(EveryPlanarBasis, RefusesNodesAndPointsOffThePlaneByName) {
  NodeCloud cloud = cloud_of_rectangle();
  const auto sentence = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const std::invalid_argument& fault) {
      return fault.what();
    }
    return {};
  };
  Points at = random_places(5);
  at(3, 2) = 2;
  const ShapeFunctions shape = shape_of(cloud);
  EXPECT_EQ(sentence([&] { shape.evaluate(at, false); }).find("point 3 has z = 2 mm"), 0U);
  EXPECT_EQ(sentence([&] { shape.interpolate(at, cloud.positions); }).find("point 3 has z = 2 mm"), 0U);
  cloud.positions(7, 2) = 1e-9;
  EXPECT_EQ(sentence([&] { shape_of(cloud); }).find("node 7 has z = 1e-09 mm"), 0U);
}

}  // namespace brainshift::solve::shape_functions_planar_test
