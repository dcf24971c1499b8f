// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/shape/shape_functions.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>

#include "segmentation/geometry/neighbour_distance.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/unit/solve/completeness.hpp"

namespace brainshift::solve::shape_functions_test {

using test::completeness_error;
using test::expect_derivatives_of_values;
using test::irregular_box;
using test::random_points;

constexpr double side = 60;

class EveryBasis : public testing::TestWithParam<Basis> {
 protected:
  ShapeOptions options() const { return {.basis = GetParam()}; }
};
INSTANTIATE_TEST_SUITE_P(Bases, EveryBasis,
                         testing::Values(Basis::linear, Basis::quadratic, Basis::modified_quadratic));

TEST_P(EveryBasis, IsAPartitionOfUnityAndLinearlyCompleteOnAnIrregularCloud) {
  EXPECT_LE(completeness_error(irregular_box(9, side), random_points(500, side), options()), 1e-10);
}

TEST_P(EveryBasis, IsCompleteTenMetresFromTheOrigin) {
  NodeCloud cloud = irregular_box(9, side);
  Points at = random_points(200, side);
  cloud.positions.rowwise() += Eigen::RowVector3d(1e4, -1e4, 5e3);
  at.rowwise() += Eigen::RowVector3d(1e4, -1e4, 5e3);
  EXPECT_LE(completeness_error(cloud, at, options()), 1e-9);
}

TEST_P(EveryBasis, IsCompleteInMetres) {
  NodeCloud cloud = irregular_box(9, side * 1e-3);
  EXPECT_LE(completeness_error(cloud, random_points(200, side * 1e-3), options()), 1e-10);
}

TEST_P(EveryBasis, HasTheDerivativesOfItsValues) {
  const NodeCloud cloud = irregular_box(8, side);
  const ShapeFunctions shape(cloud.positions, cloud.spacing, options());
  const Points at = random_points(60, side);
  expect_derivatives_of_values(shape, cloud.positions, at, 3);
}

double quadratic_error(Basis basis) {
  const NodeCloud cloud = irregular_box(9, side);
  const Points at = random_points(300, side);
  const auto field = [](const Points& x) {
    Points u(x.rows(), 3);
    u.col(0) = x.col(0).cwiseProduct(x.col(1)) / side;
    u.col(1) = x.col(2).cwiseAbs2() / side;
    u.col(2) = (x.col(0) - x.col(2)).cwiseAbs2() / side;
    return u;
  };
  const ShapeFunctions shape(cloud.positions, cloud.spacing, {.basis = basis});
  return (shape.interpolate(at, field(cloud.positions)) - field(at)).cwiseAbs().maxCoeff();
}

TEST(ShapeFunctions, ReproduceQuadraticFieldsWithTheQuadraticBasis) {
  EXPECT_LE(quadratic_error(Basis::quadratic), 1e-9);
}

TEST(ShapeFunctions, ReproduceQuadraticFieldsUpToThePenaltyWithTheModifiedBasis) {
  EXPECT_LE(quadratic_error(Basis::modified_quadratic),
            1e-2);                                 // µ = 1e-7 over second moments of 1e-3 and more, times 60 mm
  EXPECT_GE(quadratic_error(Basis::linear), 0.1);  // the test can tell
}

TEST(ShapeFunctions, OfTheModifiedBasisNeedNoMoreNodesThanLinearOnes) {
  const NodeCloud cloud = irregular_box(2, 10);  // eight corners: quadratic MLS is singular
  const Points centre = Points::Constant(1, 3, 5.0);
  const ShapeOptions modified{.basis = Basis::modified_quadratic, .dilatation = 1.5};
  EXPECT_LE(completeness_error(cloud, centre, modified), 1e-8);  // the penalty, 1e-7, is all that holds the squares
  EXPECT_THROW(ShapeFunctions(cloud.positions, cloud.spacing, {.basis = Basis::quadratic}), std::invalid_argument);
}

TEST(ShapeFunctions, GrowASupportThatIsTooSmallAndCountIt) {
  const NodeCloud cloud = irregular_box(6, side);
  const ShapeOptions small{.basis = Basis::linear, .dilatation = 0.6};
  const Points at = random_points(50, side);
  EXPECT_GT(ShapeFunctions(cloud.positions, cloud.spacing, small).evaluate(at, false).grown, 25u);
  EXPECT_LE(completeness_error(cloud, at, small), 1e-10);
}

/// The nodes at a corner are farther from their six nearest than the others.
TEST_P(EveryBasis, IsCompleteAtTheCornerOfACloudWithoutAStatedSpacing) {
  NodeCloud cloud = irregular_box(9, side, 0.4);
  cloud.spacing = mean_neighbour_distance(nearest_neighbours(cloud.positions, 6));
  const Points at = random_points(500, side / 16);
  EXPECT_LE(completeness_error(cloud, at, options()), 1e-10);
}

TEST_P(EveryBasis, LeaveRowsEmptyWhereNoSupportIsAdmissible) {
  const NodeCloud cloud = irregular_box(8, side);
  const ShapeFunctions shape(cloud.positions, cloud.spacing, options());
  Points at = random_points(40, side);
  const ShapeRows all = shape.evaluate(at, true);
  at.row(7) << 3 * side, 0, 0;
  const ShapeRows rows = shape.evaluate_where_admissible(at, true, 1.7);
  for (std::size_t p = 0; p < rows.size(); ++p) {
    if (p == 7) {
      EXPECT_EQ(rows[p].size(), 0U);
    } else {
      EXPECT_TRUE(std::ranges::equal(rows[p].node, all[p].node));
      EXPECT_TRUE(std::ranges::equal(rows[p].derivative, all[p].derivative));
    }
  }
}

TEST(ShapeFunctions, RefuseACloudInOnePlane) {
  NodeCloud cloud = irregular_box(5, side);
  cloud.positions.col(2).setZero();
  const ShapeFunctions shape(cloud.positions, cloud.spacing, {.basis = Basis::linear});
  EXPECT_THROW(shape.evaluate(random_points(3, side), false), std::invalid_argument);
}

TEST(ShapeFunctions, WithDiffuseDerivativesStayLinearlyComplete) {
  ShapeOptions diffuse{.basis = Basis::linear, .derivatives = Derivatives::diffuse};
  EXPECT_LE(completeness_error(irregular_box(9, side), random_points(200, side), diffuse), 1e-10);
}

TEST(ShapeFunctions, AreTheSameForAnyNumberOfThreads) {
  const NodeCloud cloud = irregular_box(8, side);
  const ShapeFunctions shape(cloud.positions, cloud.spacing, {});
  const Points at = random_points(2000, side);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const ShapeRows one = shape.evaluate(at, true);
  omp_set_num_threads(3);
  const ShapeRows three = shape.evaluate(at, true);
  omp_set_num_threads(threads);
  EXPECT_EQ(one.node, three.node);
  EXPECT_EQ(one.derivative, three.derivative);
}

/// Largest difference at a place between the field found together with its neighbours and alone, mm. Cubes of places a
/// millimetre apart, from the middle of the cloud to a little outside it, where supports are grown.
double together_and_alone(const NodeCloud& cloud, const ShapeOptions& options,
                          std::shared_ptr<const Visibility> visibility = nullptr) {
  const ShapeFunctions shape(cloud.positions, cloud.spacing, options, std::move(visibility));
  const Points values = cloud.positions.array().sin();
  const Eigen::RowVector3d middle = Eigen::RowVector3d::Constant(side / 2);
  double largest = 0;
  for (double way = 0; way < 0.75 * side; way += 1.7) {
    Points places(27, 3);
    for (int n = 0; n < 27; ++n) {
      places.row(n) = middle + way * Eigen::RowVector3d(1, 0.6, -0.7).normalized() +
                      Eigen::RowVector3d(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
    }
    const Points together = shape.interpolate(places, values);
    for (Eigen::Index n = 0; n < places.rows(); ++n) {
      largest = std::max(largest, (together.row(n) - shape.interpolate(places.row(n), values)).norm());
    }
  }
  return largest;
}

TEST_P(EveryBasis, GivesTheFieldOfManyPlacesAsOfEachAlone) {
  EXPECT_EQ(together_and_alone(irregular_box(11, side), options()), 0);
}

TEST(ShapeFunctions, GiveTheFieldOfManyPlacesAsOfEachAloneWithAHighPenaltyAndSpacingsThatDiffer) {
  NodeCloud cloud = irregular_box(11, side);
  for (std::size_t n = 0; n < cloud.spacing.size(); ++n) {
    cloud.spacing[n] *= n % 3 == 0 ? 1.3 : 1;
  }
  EXPECT_EQ(together_and_alone(cloud, {.basis = Basis::modified_quadratic, .penalty = 1e-5}), 0);
}

TEST(ShapeFunctions, GiveTheFieldOfManyPlacesAsOfEachAloneBesideACut) {
  CutFacets cut;
  cut.vertices.resize(3, 3);
  cut.vertices << 33, 25, -10, 33, -20, 60, 33, 70, 60;
  cut.facets.resize(1, 3);
  cut.facets << 0, 1, 2;
  cut.front = {{0, 1}, {1, 2}, {2, 0}};
  EXPECT_EQ(together_and_alone(irregular_box(11, side), {}, std::make_shared<const Visibility>(cut)), 0);
}

}  // namespace brainshift::solve::shape_functions_test
