// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/output/field_difference.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::field_difference_test {

constexpr double side = 40;

/// Nodes that move by H·X.
Solution linear(const NodeCloud& cloud, const Eigen::Matrix3d& h) {
  return {.positions = cloud.positions,
          .displacement = cloud.positions * h.transpose(),
          .reaction_force = Points::Zero(cloud.positions.rows(), 3),
          .spacing = cloud.spacing,
          .shape = {}};
}

const Eigen::Matrix3d slope{{0.1, 0.2, 0}, {-0.1, 0.05, 0.1}, {0, 0.2, -0.1}};

TEST(FieldDifference, HasTheLargestThe95thPercentileAndTheMean) {
  Points u = Points::Zero(100, 3), v = u;
  for (Eigen::Index i = 0; i < 100; ++i) {
    v.row((37 * i) % 100) = static_cast<double>(i + 1) * Eigen::RowVector3d(2, -1, 2) / 3;  // lengths 1 to 100
  }
  const FieldDifference difference = field_difference(u, v);
  EXPECT_DOUBLE_EQ(difference.largest, 100);
  EXPECT_NEAR(difference.percentile_95, 95.5, 0.6);
  EXPECT_NEAR(difference.mean, 50.5, 1e-12);
  EXPECT_DOUBLE_EQ(field_difference(v, u).largest, 100);
}

TEST(FieldDifference, OfOnePointIsItsOwn) {
  const Points u{{0, 0, 0}}, v{{3, 4, 0}};
  const FieldDifference difference = field_difference(u, v);
  EXPECT_EQ(difference.largest, 5);
  EXPECT_EQ(difference.percentile_95, 5);
  EXPECT_EQ(difference.mean, 5);
}

TEST(FieldDifference, OfOneLinearFieldOnTwoCloudsIsNone) {
  const Solution coarse = linear(test::irregular_box(5, side), slope);
  const Solution fine = linear(test::irregular_box(8, side, 0.25, 5), slope);
  EXPECT_LE(field_difference(coarse, fine).largest, 1e-7);
  EXPECT_LE(field_difference(fine, coarse).largest, 1e-7);
}

TEST(FieldDifference, OfTwoSolutionsIsAtTheNodesOfTheReference) {
  const Solution reference = linear(test::irregular_box(5, side), slope);
  Solution other = linear(test::irregular_box(7, side), slope);
  other.displacement.rowwise() += Eigen::RowVector3d(0, 0.3, 0.4);
  const FieldDifference difference = field_difference(reference, other);
  EXPECT_NEAR(difference.largest, 0.5, 1e-7);
  EXPECT_NEAR(difference.mean, 0.5, 1e-7);
}

TEST(FieldDifference, DisplacementAtTheNodesIsTheirs) {
  const NodeCloud cloud = test::irregular_box(6, side);
  Solution solution = linear(cloud, slope);
  solution.displacement += test::random_points(static_cast<int>(cloud.size()), 2);
  EXPECT_LE((displacement_at(solution, cloud.positions) - solution.displacement).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(FieldDifference, NeedsTheSamePointsAndAtLeastOne) {
  EXPECT_THROW(field_difference(Points(0, 3), Points(0, 3)), std::invalid_argument);
  EXPECT_THROW(field_difference(Points::Zero(2, 3), Points::Zero(3, 3)), std::invalid_argument);
}

}  // namespace brainshift::solve::field_difference_test
