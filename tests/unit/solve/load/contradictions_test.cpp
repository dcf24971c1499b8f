// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/contradictions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "solve/load/joined_points.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::contradictions_test {

/// A tilted dip of up to 8 mm, measured at these places with noise of 0.5 mm along each axis.
CraniotomyLoad measured_at(const Points& places) {
  std::mt19937_64 chance(1);
  std::normal_distribution<double> noise(0, 0.5);
  CraniotomyLoad load{places, Points(places.rows(), 3), Points::Constant(places.rows(), 3, 0.5)};
  for (Eigen::Index p = 0; p < places.rows(); ++p) {
    load.displacement.row(p) << noise(chance), noise(chance), -0.08 * places(p, 0) + noise(chance);
  }
  return load;
}

Points twice(const Points& places) {
  Points both(2 * places.rows(), 3);
  both << places, places;
  return both;
}

TEST(Contradictions, AreNoneAmongPointsThatAgree) {
  for (const Points& places :
       {test::random_points(50, 100), twice(test::random_points(50, 100)), test::random_points(10000, 100)}) {
    CraniotomyLoad load = measured_at(places);
    EXPECT_FALSE(worst_of_joined(load)) << places.rows();
    EXPECT_EQ(lessen_joined(load).positions.rows(), 0) << places.rows();
    EXPECT_TRUE((load.sigma.array() == 0.5).all());
  }
}

/// Their mean is 15 mm from either, and fits all others.
TEST(Contradictions, OfTwoMeasurementsOfOnePlaceBothAreLessened) {
  const Points places = test::random_points(20, 100);
  CraniotomyLoad load = measured_at(twice(places));
  load.displacement(27, 1) += 30;
  const std::optional<Outlier> worst = worst_of_joined(load);
  ASSERT_TRUE(worst);
  EXPECT_EQ(worst->position, places.row(7).transpose());
  EXPECT_NEAR(worst->deviations, 30 / (0.5 * std::sqrt(2.0)), 5);
  EXPECT_EQ(lessen_joined(load).positions, twice(places.row(7)));
  EXPECT_FALSE(worst_of_joined(load));
}

TEST(Contradictions, OfThreeTheOneThatIsWrongIsLessened) {
  Points places = test::random_points(20, 100);
  places.row(18) = places.row(19) = places.row(17);
  CraniotomyLoad load = measured_at(places);
  load.displacement(18, 0) += 30;
  const Eigen::RowVector3d right = 0.5 * (load.displacement.row(17) + load.displacement.row(19));
  EXPECT_EQ(lessen_joined(load).positions.rows(), 1);
  EXPECT_GT(load.sigma(18, 0), 10);
  EXPECT_EQ(load.sigma(17, 0), 0.5);
  const CraniotomyLoad joint = joined(load, most_measured_points);
  EXPECT_LT((joint.displacement.rowwise() - right).rowwise().norm().minCoeff(), 0.05);
}

/// Of 10,000 points, which lie in cells of many, one would move the mean of its cell by less than its noise.
TEST(Contradictions, AreSeenAmongThousandsOfPoints) {
  CraniotomyLoad load = measured_at(test::random_points(10000, 100));
  load.displacement(1234, 2) += 30;
  const std::optional<Outlier> worst = worst_of_joined(load);
  ASSERT_TRUE(worst);
  EXPECT_EQ(worst->position, load.positions.row(1234).transpose());
  EXPECT_EQ(lessen_joined(load).positions, load.positions.row(1234));
}

/// Of neither kind there are too many, so that none are joined: those of a cell need not agree.
TEST(Contradictions, AreLookedForAmongPointsThatAreJoinedAlone) {
  CraniotomyLoad load = measured_at(test::random_points(200, 100));
  load.displacement.col(0) += 5 * load.positions.col(1);
  std::vector<Eigen::Index> inner;
  for (Eigen::Index p = 1; p < 200; p += 2) {
    inner.push_back(p);
  }
  EXPECT_TRUE(worst_of_joined(load)) << "all of the cortex";
  EXPECT_FALSE(worst_of_joined(load, inner));
  EXPECT_EQ(lessen_joined(load, inner).positions.rows(), 0);
  load.positions.row(7) = load.positions.row(3);
  load.displacement.row(7) = load.displacement.row(3).array() + 30;
  const std::optional<Outlier> worst = worst_of_joined(load, inner);
  ASSERT_TRUE(worst);
  EXPECT_EQ(worst->position, load.positions.row(7).transpose());
  EXPECT_EQ(lessen_joined(load, inner).positions.rows(), 2);
}

}  // namespace brainshift::solve::contradictions_test
