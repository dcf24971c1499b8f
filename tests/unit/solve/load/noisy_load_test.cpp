// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/noisy_load.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "solve/load/joined_points.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::noisy_load_test {

using test::refusal;

constexpr double side = 60;

/// Points on the upper face of a box and one in its middle.
CraniotomyLoad face_and_middle() {
  CraniotomyLoad load{Points(10, 3), Points::Zero(10, 3), Points::Constant(10, 3, 0.5)};
  for (Eigen::Index p = 0; p < 9; ++p) {
    load.positions.row(p) << 15 + 15.0 * static_cast<double>(p % 3), 15 + 15.0 * static_cast<double>(p / 3), side;
    load.displacement.row(p) << 0.1 * static_cast<double>(p), 0, -2;
  }
  load.positions.row(9) << 30, 31, 29;
  load.displacement.row(9) << 0, 0, -1;
  return load;
}

TEST(NoisyLoad, PrescribesAtTheCortexWhatTheExactLoadDoesAndKeepsPointsInsideApart) {
  const NodeCloud cloud = test::irregular_box(9, side);
  const CraniotomyLoad load = face_and_middle();
  const Conditions conditions = noisy_conditions(cloud, load);
  const CraniotomyLoad cortex{load.positions.topRows(9), load.displacement.topRows(9)};
  const Points exact = prescribed_on_surface_nodes(cloud, cortex);
  ASSERT_TRUE(conditions.measured);
  EXPECT_TRUE((conditions.displacement.array().isNaN() == exact.array().isNaN()).all());
  EXPECT_TRUE((conditions.displacement.array().isNaN() || conditions.displacement.array() == exact.array()).all());
  EXPECT_EQ(conditions.measured->inner, load.positions.bottomRows(1));
  EXPECT_EQ(conditions.measured->inner_displacement, load.displacement.bottomRows(1));
}

TEST(NoisyLoad, CountsAPointAsInsideByItsDepthBelowTheSurface) {
  const Points places{{30, 30, side - 7}, {30, 30, side}, {25, 35, side + 6}, {20, 24, side - 8}};
  const CraniotomyLoad load{places, Points::Zero(4, 3), Points::Constant(4, 3, 0.5)};
  EXPECT_EQ(inner_points(test::irregular_box(9, side), load), (std::vector<Eigen::Index>{0, 3}));
}

/// The surface nodes nearest to a deep point lie on several sides of it.
TEST(NoisyLoad, TakesNoDeepPointForOneOfTheCortex) {
  NodeCloud cloud = test::irregular_box(9, side);
  cloud.positions.col(0) *= 0.5;
  std::vector<Eigen::Index> deep;
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    const Eigen::RowVector3d x = cloud.positions.row(a), most(side / 2, side, side);
    if (std::min(x.minCoeff(), (most - x).minCoeff()) > 10) {
      deep.push_back(a);
    }
  }
  ASSERT_GT(deep.size(), 20U);
  const auto count = static_cast<Eigen::Index>(deep.size());
  const CraniotomyLoad load{cloud.positions(deep, Eigen::all), Points::Ones(count, 3), Points::Constant(count, 3, 0.5)};
  EXPECT_EQ(noisy_conditions(cloud, load).measured->inner.rows(), count);
}

TEST(NoisyLoad, SharesOfTheCortexAddUpToOneAndGiveBackWhatIsPrescribed) {
  const NodeCloud cloud = test::irregular_box(9, side);
  const CraniotomyLoad load = face_and_middle();
  const Conditions conditions = noisy_conditions(cloud, load);
  const Eigen::MatrixXd spread = conditions.measured->spread;
  const Points shared = spread * load.displacement.topRows(9);
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    EXPECT_NEAR(spread.row(a).sum(), conditions.is_prescribed(a) ? 1 : 0, 1e-12);
    if (conditions.is_prescribed(a)) {
      EXPECT_LT((shared.row(a) - conditions.displacement.row(a)).norm(), 0.1);
    }
  }
}

TEST(NoisyLoad, JoinsPointsInOnePlaceAndTooManyByTheirVariances) {
  CraniotomyLoad load{Points::Zero(3, 3), Points(3, 3), Points(3, 3)};
  load.positions(2, 0) = 40;
  load.displacement << 0, 0, 0, 5, 5, 5, 7, 7, 7;
  load.sigma << 1, 1, 1, 2, 2, 2, 3, 3, 3;
  const CraniotomyLoad joint = joined(load, 100);
  ASSERT_EQ(joint.positions.rows(), 2);
  EXPECT_NEAR(joint.displacement(0, 1), 1, 1e-12);  // (0/1 + 5/4) / (1 + 1/4)
  EXPECT_NEAR(joint.sigma(0, 1), std::sqrt(0.8), 1e-12);
  CraniotomyLoad many{test::random_points(100000, 100), Points::Ones(100000, 3), Points::Ones(100000, 3)};
  const CraniotomyLoad few = joined(many, most_measured_points);
  EXPECT_LE(few.positions.rows(), most_measured_points);
  EXPECT_GT(few.positions.rows(), most_measured_points / 4);
  EXPECT_NEAR(few.sigma.col(0).cwiseAbs2().cwiseInverse().sum(), 100000, 1e-6);
}

TEST(NoisyLoad, RefusesAPointOutsideTheHeadAndOneWithoutStandardDeviation) {
  const NodeCloud cloud = test::irregular_box(9, side);
  CraniotomyLoad load = face_and_middle();
  load.positions.row(9) << 30, 30, side + 25;
  EXPECT_NE(refusal([&] { noisy_conditions(cloud, load); }).find("measured point 10 of 10"), std::string::npos);
  load.positions.row(0) = face_and_middle().positions.row(9);  // inside: those outside are looked at alone
  EXPECT_NE(refusal([&] { noisy_conditions(cloud, load); }).find("measured point 10 of 10"), std::string::npos);
  load = face_and_middle();
  load.sigma(3, 1) = 0;
  EXPECT_NE(refusal([&] { noisy_conditions(cloud, load); }).find("standard deviation"), std::string::npos);
  load = face_and_middle();
  load.displacement(9, 1) = std::nan("");  // of the point inside
  EXPECT_NE(refusal([&] { noisy_conditions(cloud, load); }).find("measured point 10 is not finite"), std::string::npos);
  EXPECT_NE(refusal([&] { noisy_conditions(cloud, {}); }).find("no displacement is measured"), std::string::npos);
}

/// Of more nodes than may be measured, those of the upper face.
Points upper_face_sinks(const NodeCloud& cloud) {
  Points displacement = Points::Constant(cloud.positions.rows(), 3, std::numeric_limits<double>::quiet_NaN());
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    if (cloud.positions(a, 2) > side - 1e-9) {
      displacement.row(a) << 0, 0, -0.1 * cloud.positions(a, 0);
    }
  }
  return displacement;
}

TEST(NoisyField, SharesTheFaultsOfAtMostSoManyNodesAmongAllWithADisplacement) {
  const NodeCloud cloud = test::irregular_box(16, side);
  Points displacement = upper_face_sinks(cloud);
  ASSERT_GT((!displacement.col(0).array().isNaN()).count(), most_measured_points);
  const Conditions conditions = noisy_field(cloud, displacement, 0.5);
  const Measurement& m = *conditions.measured;
  ASSERT_EQ(m.sigma.rows(), most_measured_points);
  EXPECT_EQ(m.inner.rows(), 0);
  const Eigen::MatrixXd spread = m.spread;
  EXPECT_GE(spread.minCoeff(), 0);
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    EXPECT_NEAR(spread.row(a).sum(), conditions.is_prescribed(a) ? 1 : 0, 1e-12);
    const bool stands_for_itself = spread.row(a).maxCoeff() > 1 - 1e-12;
    Eigen::Index point = 0;
    spread.row(a).maxCoeff(&point);
    EXPECT_TRUE(!stands_for_itself || m.cortex.row(point) == cloud.positions.row(a));
  }
  EXPECT_NE(refusal([&] { noisy_field(cloud, displacement, 0); }).find("standard deviation"), std::string::npos);
  displacement.setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_NE(refusal([&] { noisy_field(cloud, displacement, 1); }).find("no node"), std::string::npos);
}

TEST(NoisyField, SharesAFaultByTheInverseOfTheSquaredDistance) {
  const NodeCloud cloud = test::irregular_box(16, side);
  const Measurement m = *noisy_field(cloud, upper_face_sinks(cloud), 0.5).measured;
  const Eigen::SparseMatrix<double, Eigen::RowMajor> spread = m.spread;
  int shared = 0;
  for (Eigen::Index a = 0; a < spread.rows(); ++a) {
    std::vector<double> products;
    for (decltype(spread)::InnerIterator entry(spread, a); entry && entry.value() < 1; ++entry) {
      products.push_back(entry.value() * (m.cortex.row(entry.col()) - cloud.positions.row(a)).squaredNorm());
    }
    for (const double product : products) {
      EXPECT_NEAR(product, products.front(), 1e-9 * products.front());
      ++shared;
    }
  }
  EXPECT_GT(shared, 0);
}

}  // namespace brainshift::solve::noisy_load_test
