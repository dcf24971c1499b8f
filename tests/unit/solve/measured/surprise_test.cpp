// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/measured/surprise.hpp"

#include <gtest/gtest.h>

#include <random>

#include "solve/load/contradictions.hpp"
#include "solve/measured/gaussian.hpp"
#include "solve/measured/weight.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/unit/solve/measured/responses.hpp"

namespace brainshift::solve::surprise_test {

using test_responses::drawn;
using test_responses::normals;
using test_responses::smooth_response;

MeasuredFit of_weight(double s) {
  MeasuredFit fit;
  fit.weight = s / millijoule;
  return fit;
}

TEST(Surprise, IsChiSquaredOfPointsThatAgreeAndLargeOfOneThatDoesNot) {
  std::mt19937 random(6);
  constexpr int points = 20, draws = 100;
  const Points places = test::random_points(points, 100);
  const Response response = smooth_response(places);
  const Points sigma = Points::Constant(points, 3, 0.5);
  double mean = 0;
  for (int draw = 0; draw < draws; ++draw) {
    const Points noise = 0.5 * Eigen::Map<const Points>(normals(3 * points, random).data(), points, 3);
    const Points measured = drawn(response, 1e4, random) + noise;
    mean += surprise(response, measured, sigma, sigma, of_weight(1e4)).squaredNorm() / (points * draws);
  }
  EXPECT_NEAR(mean, 3, 0.15);
  Points contradicted = drawn(response, 1e4, random);
  contradicted.row(7) += Eigen::RowVector3d(0, 30, 0);
  const Eigen::VectorXd off = surprise(response, contradicted, sigma, sigma, of_weight(1e4));
  Eigen::Index most = 0;
  EXPECT_GT(off.maxCoeff(&most), 10);
  EXPECT_EQ(most, 7);
}

TEST(RobustTrust, TakePointsOutThatContradictTheOthersAndLeaveTheRestAlmostWhole) {
  std::mt19937 random(5);
  const Points places = test::random_points(30, 100);
  const Response response = smooth_response(places);
  const Points sigma = Points::Constant(30, 3, 0.3);
  for (int draw = 0; draw < 10; ++draw) {
    const Points noise = Eigen::Map<const Points>(normals(90, random).data(), 30, 3);
    Points d = drawn(response, 4e3, random) + 0.3 * noise;
    const Eigen::VectorXd sound = robust_trust(response, d, sigma, 0).weight;
    EXPECT_GT(sound.mean(), 0.75);
    d.row(3) += Eigen::RowVector3d(0, 10, 0);
    d.row(20) += Eigen::RowVector3d(-6, 0, 8);
    const auto& [weights, surprises] = robust_trust(response, d, sigma, 0);
    EXPECT_LT(std::max(weights[3], weights[20]), 0.01) << draw;
    EXPECT_GT(std::min(surprises[3], surprises[20]), surprising) << draw;
    EXPECT_EQ((surprises.array() > surprising).count(), 2) << draw;
    EXPECT_GT(weights.sum() / 28, 0.75) << draw;
  }
}

TEST(RobustTrust, DoNotBlameThePointsWhereTheNoiseIsSaidToBeTooSmall) {
  std::mt19937 random(6);
  const Points places = test::random_points(30, 100);
  const Response response = smooth_response(places);
  const Points noise = Eigen::Map<const Points>(normals(90, random).data(), 30, 3);
  const Points d = drawn(response, 4e3, random) + noise;
  EXPECT_GT(robust_trust(response, d, Points::Constant(30, 3, 0.1), 0).weight.mean(), 0.7);
}

}  // namespace brainshift::solve::surprise_test
