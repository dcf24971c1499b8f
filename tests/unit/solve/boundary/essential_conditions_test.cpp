// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/essential_conditions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "solve/boundary/contact.hpp"
#include "solve/shape/shape_functions.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/unit/solve/weighted_box.hpp"

namespace brainshift::solve::essential_conditions_test {

using test::irregular_box;
using test::random_points;

constexpr double side = 40;

std::vector<std::int32_t> names(const Points& prescribed) {
  std::vector<std::int32_t> names(static_cast<std::size_t>(prescribed.rows()));
  std::iota(names.begin(), names.end(), 0);
  return names;
}

TEST(EssentialConditions, HoldForTheDisplacementNotTheParameter) {
  WeightedBox cloud;
  Points prescribed = Points::Constant(cloud.nodes.positions.rows(), 3, std::nan(""));
  for (Eigen::Index a = 0; a < prescribed.rows(); a += 5) {
    prescribed.row(a) << 1.0, std::nan(""), -2.0;
  }
  prescribed(3, 1) = 0.5;
  EssentialConditions conditions(prescribed, cloud.rows, names(prescribed));
  conditions.factorise(cloud.mass);
  NodalVectors u = cloud.random_parameters(3);
  conditions.apply(0.7, u);
  EXPECT_LE(conditions.largest_error(0.7, u), 1e-10);
  const Points displacement = cloud.displacement(u);
  for (Eigen::Index i = 0; i < prescribed.size(); ++i) {
    if (!std::isnan(prescribed.data()[i])) {
      EXPECT_NEAR(displacement.data()[i], 0.7 * prescribed.data()[i], 1e-10);
    }
  }
}

TEST(EssentialConditions, MayPrescribeOtherValuesAtTheSameNodes) {
  WeightedBox cloud;
  Points prescribed = Points::Constant(cloud.nodes.positions.rows(), 3, std::nan(""));
  for (Eigen::Index a = 0; a < prescribed.rows(); a += 5) {
    prescribed.row(a) << 1.0, std::nan(""), 0.0;
  }
  EssentialConditions conditions(prescribed, cloud.rows, names(prescribed));
  conditions.factorise(cloud.mass);
  NodalVectors u = cloud.random_parameters(3), again = u;
  conditions.apply(1, u);
  Points other = prescribed;
  other.row(0) << 0.0, std::nan(""), 0.0;
  other.row(5) << -2.0, std::nan(""), 0.5;
  ASSERT_TRUE(conditions.prescribe(other));
  EXPECT_EQ(conditions.reactions(1, cloud.mass.size()), Points::Zero(other.rows(), 3));
  conditions.factorise(cloud.mass);
  conditions.apply(1, again);
  EssentialConditions anew(other, cloud.rows, names(other));
  anew.factorise(cloud.mass);
  NodalVectors expected = cloud.random_parameters(3);
  anew.apply(1, expected);
  EXPECT_EQ(again, expected);
  EXPECT_EQ(conditions.reaction_of_loaded(1), anew.reaction_of_loaded(1));
  other(5, 1) = 0;
  EXPECT_FALSE(conditions.prescribe(other));
}

/// A factorisation is that of the masses given last.
TEST(EssentialConditions, FollowTheMasses) {
  WeightedBox cloud;
  Points prescribed = Points::Constant(cloud.nodes.positions.rows(), 3, std::nan(""));
  prescribed.row(0).setConstant(1);
  prescribed.row(7).setConstant(2);
  EssentialConditions conditions(prescribed, cloud.rows, names(prescribed));
  std::vector<double> mass = cloud.mass;
  conditions.factorise(mass);
  mass[1] *= 3;
  conditions.factorise(mass);
  EssentialConditions anew(prescribed, cloud.rows, names(prescribed));
  anew.factorise(mass);
  NodalVectors u = cloud.random_parameters(3), expected = u;
  conditions.apply(1, u);
  anew.apply(1, expected);
  EXPECT_EQ(u, expected);
}

TEST(EssentialConditions, MoveTheParametersLeastInTheNormOfTheMasses) {
  // A projection: doing it twice changes nothing, and the correction M⁻¹Vᵀμ is M-orthogonal to every motion that keeps
  // the conditions.
  WeightedBox cloud;
  Points prescribed = Points::Constant(cloud.nodes.positions.rows(), 3, std::nan(""));
  for (Eigen::Index a = 0; a < prescribed.rows(); a += 7) {
    prescribed.row(a).setConstant(1.0);
  }
  EssentialConditions conditions(prescribed, cloud.rows, names(prescribed));
  conditions.factorise(cloud.mass);
  const NodalVectors start = cloud.random_parameters(3);
  NodalVectors once = start, other = cloud.random_parameters(1);
  conditions.apply(1, once);
  conditions.apply(1, other);
  NodalVectors twice = once;
  conditions.apply(1, twice);
  double product = 0, change = 0;
  for (std::size_t i = 0; i < once.size(); ++i) {
    change = std::max(change, std::abs(twice[i] - once[i]));
    product += cloud.mass[i / 4] * (once[i] - start[i]) * (other[i] - once[i]);
  }
  EXPECT_LE(change, 1e-10);
  EXPECT_LE(std::abs(product), 1e-8);
}

TEST(EssentialConditions, RefuseTwoNodesThatSayTheSame) {
  WeightedBox cloud;
  ShapeRows same = cloud.rows;  // node 1 seen as node 0: both rows alike
  Points prescribed = Points::Constant(cloud.nodes.positions.rows(), 3, std::nan(""));
  prescribed.topRows(2).setZero();
  const auto length = static_cast<std::size_t>(same.begin[1]);
  std::vector<std::int32_t> node(same.node.begin(), same.node.begin() + static_cast<std::ptrdiff_t>(length));
  std::vector<double> value(same.value.begin(), same.value.begin() + static_cast<std::ptrdiff_t>(length));
  const std::int64_t removed = same.begin[2] - same.begin[1];
  same.node.erase(same.node.begin() + same.begin[1], same.node.begin() + same.begin[2]);
  same.value.erase(same.value.begin() + same.begin[1], same.value.begin() + same.begin[2]);
  same.node.insert(same.node.begin() + same.begin[1], node.begin(), node.end());
  same.value.insert(same.value.begin() + same.begin[1], value.begin(), value.end());
  for (std::size_t i = 2; i < same.begin.size(); ++i) {
    same.begin[i] += static_cast<std::int64_t>(length) - removed;
  }
  EssentialConditions conditions(prescribed, same, names(prescribed));
  EXPECT_THROW(conditions.factorise(cloud.mass), std::invalid_argument);
}

/// Every fifth node is measured, for itself; and a point inside.
struct MeasuredBox : WeightedBox {
  Points prescribed = Points::Constant(nodes.positions.rows(), 3, std::nan(""));
  Measurement measured;
  ShapeRows inner;

  explicit MeasuredBox(double sigma) {
    std::vector<Eigen::Triplet<double>> share;
    for (Eigen::Index a = 0; a < prescribed.rows(); a += 5) {
      prescribed.row(a) << 1, 0.5, -2;
      share.emplace_back(static_cast<int>(a), static_cast<int>(share.size()), 1.0);
    }
    const auto points = static_cast<Eigen::Index>(share.size());
    measured.spread.resize(prescribed.rows(), points);
    measured.spread.setFromTriplets(share.begin(), share.end());
    measured.sigma = sigma * (Points::Ones(points, 3) + random_points(static_cast<int>(points), 1));
    measured.inner = Points::Constant(1, 3, side / 2);
    measured.inner_displacement = Points::Constant(1, 3, 3);
    measured.inner_sigma = Points::Constant(1, 3, sigma);
    measured.weight = 1;
    inner = shape.evaluate(measured.inner, false);
  }
};

TEST(MeasuredConditions, AreTheExactOnesAsTheNoiseVanishes) {
  MeasuredBox box(1e-6);
  EssentialConditions soft(box.prescribed, box.rows, names(box.prescribed), box.measured, box.inner);
  soft.factorise(box.mass, 3);
  NodalVectors u = box.random_parameters(3);
  soft.apply(1, u);
  EXPECT_LE(soft.largest_error(1, u), 1e-5);
}

TEST(MeasuredConditions, GiveWayByVarianceTimesForceOverWeight) {
  constexpr double alpha = 3, weight = 1e6;  // of 1 mJ, µN mm
  MeasuredBox box(800);
  EssentialConditions soft(box.prescribed, box.rows, names(box.prescribed), box.measured, box.inner);
  soft.factorise(box.mass, alpha);
  NodalVectors u = box.random_parameters(3);
  soft.apply(0.7, u);
  const Points force = soft.reactions(alpha, box.nodes.size()), displacement = box.displacement(u);
  double largest = 0;
  for (Eigen::Index p = 0; p < box.measured.sigma.rows(); ++p) {
    for (int axis = 0; axis < 3; ++axis) {
      const double residual = 0.7 * box.prescribed(5 * p, axis) - displacement(5 * p, axis);
      const double given = std::pow(box.measured.sigma(p, axis), 2) * force(5 * p, axis) / weight;
      EXPECT_NEAR(residual, given, 1e-9);
      largest = std::max(largest, std::abs(residual));
    }
  }
  EXPECT_GT(largest, 0.01);
}

TEST(MeasuredConditions, OfAPointInsideGiveWayAlongEachAxisByItsOwnDeviation) {
  MeasuredBox box(800);
  box.measured.sigma.setConstant(800);
  box.measured.inner_sigma(0, 1) = 1e-6;
  EssentialConditions soft(box.prescribed, box.rows, names(box.prescribed), box.measured, box.inner);
  soft.factorise(box.mass, 3);
  NodalVectors u = box.random_parameters(3);
  soft.apply(1, u);
  Eigen::Vector3d moved = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < box.inner[0].size(); ++k) {
    moved += box.inner[0].value[k] * at(u, static_cast<std::size_t>(box.inner[0].node[k])).head<3>();
  }
  EXPECT_NEAR(moved[1], 3, 1e-4);
  EXPECT_GT(std::abs(moved[0] - 3), 0.1);
}

TEST(MeasuredConditions, AddTheirSpringsToTheStiffnessOfAStep) {
  constexpr double alpha = 3, weight = 1e6;
  MeasuredBox box(800);
  box.measured.inner = box.measured.inner_displacement = box.measured.inner_sigma = Points(0, 3);
  EssentialConditions soft(box.prescribed, box.rows, names(box.prescribed), box.measured, {});
  soft.factorise(box.mass, alpha);
  NodalVectors first = box.random_parameters(1), second = box.random_parameters(2);
  soft.apply(0.5, first);
  soft.apply(1, first);
  EXPECT_EQ(soft.spring_work(first, first), 0);  // the load came on
  soft.apply(1, first);
  soft.apply(1, second);
  const Points moved = box.displacement(second) - box.displacement(first);
  double work = 0;
  for (Eigen::Index p = 0; p < box.measured.sigma.rows(); ++p) {
    work += alpha * weight * moved.row(5 * p).cwiseQuotient(box.measured.sigma.row(p)).squaredNorm();
  }
  EXPECT_NEAR(soft.spring_work(first, second), work, 1e-6 * work);
}

}  // namespace brainshift::solve::essential_conditions_test
