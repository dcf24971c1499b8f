// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>
#include <vector>

#include "solve/measured/gaussian.hpp"
#include "solve/measured/weight.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/unit/solve/measured/responses.hpp"

namespace brainshift::solve::smooth_motion_test {

using test_responses::normals;
using test_responses::rough_response;
using test_responses::smooth_response;
using test_responses::smoothly_drawn;

/// Places of an opening of 40 by 20 mm, which a smooth motion may leave as they are at the rim.
Response opening_response(int count) {
  Points places = test::random_points(count, 2);
  places = (places.rowwise() - places.colwise().mean()).eval();
  places.col(0) *= 20;
  places.col(1) *= 10;
  places.col(2).setZero();
  Response response = rough_response(places);
  response.fading = fading_to_rim(places);
  return response;
}

TEST(SmoothMotion, OfTheOpeningIsFoundWhereThereIsOneAndOnlyThere) {
  std::mt19937 random(8);
  const Points places = test::random_points(40, 100);
  const Response response = rough_response(places);
  const Points sigma = Points::Constant(40, 3, 0.5);
  double length = 0, along = 0, across = 0;
  int found = 0;
  for (int draw = 0; draw < 10; ++draw) {
    const Points noise = 0.5 * Eigen::Map<const Points>(normals(120, random).data(), 40, 3);
    const SmoothMotion truth{40, 4, 0.5, Eigen::Vector3d(1, 2, -2) / 3};
    const MeasuredFit fit = choose_weight(response, smoothly_drawn(response, truth, random) + noise, sigma);
    length += fit.smooth.length / 10;
    along += fit.smooth.along / 10;
    across += fit.smooth.across / 10;
    EXPECT_GT(std::abs(fit.smooth.direction.dot(truth.direction)), 0.97);
    const Points rough = Eigen::Map<const Points>(normals(120, random).data(), 40, 3);
    found += choose_weight(response, 2 * rough, sigma).smooth.length > 0 ? 1 : 0;
  }
  EXPECT_GT(length, 25);
  EXPECT_LT(length, 60);
  EXPECT_GT(along, 2.5);
  EXPECT_LT(along, 6);
  EXPECT_GT(across, 0.2);
  EXPECT_LT(across, 1);
  EXPECT_LE(found, 1) << "of ten that are rough alone";
}

TEST(SmoothMotion, OfMaternIsAlikeByHalfOverItsLength) {
  const Response response = rough_response(Points{{0, 0, 0}, {10, 0, 0}});
  const Eigen::MatrixXd covariance =
      smooth_covariance(response, {.length = 10}, Eigen::Matrix3d::Identity(), Alike::matern);
  EXPECT_NEAR(covariance(0, 3), (1 + std::sqrt(5) + 5.0 / 3) * std::exp(-std::sqrt(5)), 1e-12);
}

TEST(SmoothMotion, FadesToATenthAtTheRimOfAnOpening) {
  const Response response = opening_response(400);
  const Points& x = response.sites;
  Eigen::Index middle = 0, rim = 0;
  x.rowwise().norm().minCoeff(&middle);
  EXPECT_DOUBLE_EQ(response.fading.minCoeff(&rim), 0.1);
  EXPECT_GT(response.fading[middle], 0.98);
  EXPECT_GT(std::hypot(x(rim, 0) / 20, x(rim, 1) / 10), 1) << "as elongated as the opening";
  EXPECT_EQ(fading_to_rim(Points::Constant(3, 3, 7.0)), Eigen::VectorXd::Ones(3));
  SmoothMotion smooth{.length = 10};
  const Eigen::MatrixXd whole = smooth_covariance(response, smooth, Eigen::Matrix3d::Identity());
  smooth.fades = true;
  const Eigen::MatrixXd left = smooth_covariance(response, smooth, Eigen::Matrix3d::Identity());
  EXPECT_DOUBLE_EQ(left(3, 6), response.fading[1] * response.fading[2] * whole(3, 6));
  EXPECT_DOUBLE_EQ(left(5, 5), response.fading[1] * response.fading[1]);
}

// What fades is nearer to the truth then, and the other is, where the whole opening moves.
TEST(SmoothMotion, IsTakenToFadeWhereItDoesAndOnlyThere) {
  std::mt19937 random(11);
  constexpr int count = 20;
  const Response response = opening_response(count);
  Response never = response;
  never.fading.resize(0);
  const Points sigma = Points::Constant(count, 3, 0.5);
  int right = 0;
  double of_fading = 0, of_other = 0;
  constexpr int draws = 20;
  for (int draw = 0; draw < draws; ++draw) {
    const Points noise = 0.5 * Eigen::Map<const Points>(normals(3 * count, random).data(), count, 3);
    Points dip = Points::Zero(count, 3), whole = dip;
    dip.col(2) = -8 * response.fading;
    whole.col(2).setConstant(-8);
    const MeasuredFit fading = choose_weight(response, dip + noise, sigma);
    right += (fading.smooth.fades ? 1 : 0) + (choose_weight(response, whole + noise, sigma).smooth.fades ? 0 : 1);
    of_fading += (fading.smoothed - dip).squaredNorm();
    of_other += (choose_weight(never, dip + noise, sigma).smoothed - dip).squaredNorm();
  }
  EXPECT_GE(right, 9 * draws / 5);
  EXPECT_LT(of_fading, 0.9 * of_other);
}

// Of a body that is stiff, neither energy nor a smooth motion has room for noise of single points.
TEST(SmoothMotion, OverTheShortestLengthIsNoiseThatWasNotGiven) {
  std::mt19937 random(6);
  const Points places = test::random_points(30, 100);
  Response response = smooth_response(places);
  response.sites = places;
  response.carry = Eigen::MatrixXd::Identity(90, 90);
  const SmoothMotion truth{50, 4, 0.3, Eigen::Vector3d::UnitZ()};
  const Points smooth = smoothly_drawn(rough_response(places), truth, random);
  const Points noise = 2 * Eigen::Map<const Points>(normals(90, random).data(), 30, 3);
  EXPECT_TRUE(choose_weight(response, smooth + noise, Points::Constant(30, 3, 0.01)).rough);
  EXPECT_FALSE(choose_weight(response, smooth + noise, Points::Constant(30, 3, 2)).rough);
  EXPECT_FALSE(choose_weight(response, smooth, Points::Constant(30, 3, 0.1)).rough);
}

// Of few points the shortest lengths are no lengths of a motion.
TEST(SmoothMotion, OfFewPointsIsNoiseThatWasNotGivenToo) {
  std::mt19937 random(12);
  int told = 0, wrongly = 0;
  for (int draw = 0; draw < 10; ++draw) {
    const Response all = opening_response(60);
    std::vector<Eigen::Index> rows;
    for (Eigen::Index p = 0; rows.size() < 14; p += 4) {
      rows.push_back((p + draw) % 60);
    }
    Response response = smooth_response(all.sites(rows, Eigen::all));  // without room for noise of single points
    response.sites = all.sites(rows, Eigen::all);
    response.carry = Eigen::MatrixXd::Identity(42, 42);
    response.shortest = 8;
    response.fading = all.fading(rows);
    Points dip = Points::Zero(14, 3);
    dip.col(2) = -8 * response.fading;
    const Points noise = Eigen::Map<const Points>(normals(42, random).data(), 14, 3);
    told += choose_weight(response, dip + 2 * noise, Points::Constant(14, 3, 0.2)).rough ? 1 : 0;
    wrongly += choose_weight(response, dip + 0.2 * noise, Points::Constant(14, 3, 0.2)).rough ? 1 : 0;
  }
  EXPECT_GE(told, 8);
  EXPECT_LE(wrongly, 1);
}

TEST(SmoothMotion, TakesNoiseOutOfThePointsAndItsEllipsoidsHoldTheTruth) {
  std::mt19937 random(9);
  constexpr int known = 30, asked = 10, draws = 40;
  const Points places = test::random_points(known + asked, 100);
  const Response response = rough_response(places);
  double noisy = 0, smoothed = 0;
  int inside = 0;
  for (int draw = 0; draw < draws; ++draw) {
    const Points truth = smoothly_drawn(response, {50, 4, 0.3, Eigen::Vector3d::UnitZ()}, random);
    const Points noise = 0.5 * Eigen::Map<const Points>(normals(3 * known, random).data(), known, 3);
    const Points d = truth.topRows(known) + noise, sigma = Points::Constant(known, 3, 0.5);
    const MeasuredFit fit = choose_weight(response, d, sigma);
    ASSERT_EQ(fit.smoothed.rows(), known);
    noisy += noise.squaredNorm();
    smoothed += (fit.smoothed - truth.topRows(known)).squaredNorm();
    const Prior prior(response, fit.weight, fit.smooth);
    Eigen::MatrixXd v = prior.between(0, 3 * known, 0, 3 * known);
    v.diagonal().array() += 0.25;
    const Eigen::VectorXd push = v.llt().solve(stacked_rows(d));
    const Posterior said(response, d, sigma, fit);
    for (int a = 0; a < asked; ++a) {
      const Eigen::Vector3d mean = prior.between(3 * (known + a), 3, 0, 3 * known) * push;
      const Eigen::Matrix3d covariance = said.covariance(a, 1);
      const Eigen::Vector3d error = truth.row(known + a).transpose() - mean;
      inside += error.dot(covariance.llt().solve(error)) <= 7.815 ? 1 : 0;
    }
  }
  EXPECT_LT(smoothed, 0.4 * noisy);
  EXPECT_GE(inside, 0.90 * draws * asked);
  EXPECT_LE(inside, 0.99 * draws * asked);
}

// What fades is known to be small at the rim, where no point may be.
TEST(SmoothMotion, ThatFadesHasEllipsoidsThatHoldTheTruth) {
  std::mt19937 random(13);
  constexpr int known = 10, asked = 20, draws = 60;
  const Response response = opening_response(known + asked);
  const Points sigma = Points::Constant(known, 3, 0.5);
  int inside = 0, fading = 0;
  for (int draw = 0; draw < draws; ++draw) {
    const SmoothMotion how{.length = 12, .along = 5, .across = 0.3, .direction = {0, 0, 1}, .fades = draw % 2 == 0};
    const Points truth = smoothly_drawn(response, how, random);
    const Points d = truth.topRows(known) + 0.5 * Eigen::Map<const Points>(normals(3 * known, random).data(), known, 3);
    const MeasuredFit fit = choose_weight(response, d, sigma);
    const Posterior said(response, d, sigma, fit);
    const Points mean = said.mean();
    fading += fit.smooth.fades ? 1 : 0;
    for (int a = 0; a < asked; ++a) {
      const Eigen::Vector3d error = (truth.row(known + a) - mean.row(a)).transpose();
      inside += error.dot(said.covariance(a, 1).llt().solve(error)) <= 7.815 ? 1 : 0;
    }
  }
  EXPECT_GT(fading, draws / 5);
  EXPECT_GE(inside, 0.90 * draws * asked) << fading;
}

// A motion that few points hardly tell from their noise is not in the answer, but may be there.
TEST(SmoothMotion, ThatIsRefusedIsInWhatIsSaid) {
  std::mt19937 random(14);
  constexpr int known = 6, asked = 20, draws = 60;
  const Response response = opening_response(known + asked);
  const Points sigma = Points::Constant(known, 3, 2);
  int inside = 0, without = 0, refused = 0;
  for (int draw = 0; draw < draws; ++draw) {
    Points truth = Points::Zero(known + asked, 3);
    truth.col(2) = -3 * response.fading;
    const Points d = truth.topRows(known) + 2 * Eigen::Map<const Points>(normals(3 * known, random).data(), known, 3);
    const MeasuredFit fit = choose_weight(response, d, sigma);
    EXPECT_NE(fit.smooth.length > 0, fit.refused.length > 0) << "the one or the other";
    if (fit.smooth.length > 0) {
      continue;
    }
    ++refused;
    MeasuredFit none = fit;
    none.refused = {};
    const Posterior said(response, d, sigma, fit), energy_alone(response, d, sigma, none);
    const Points mean = said.mean();
    EXPECT_EQ(mean, energy_alone.mean()) << "the answer leaves it out";
    for (int a = 0; a < asked; ++a) {
      const Eigen::Vector3d error = (truth.row(known + a) - mean.row(a)).transpose();
      inside += error.dot(said.covariance(a, 1).llt().solve(error)) <= 7.815 ? 1 : 0;
      without += error.dot(energy_alone.covariance(a, 1).llt().solve(error)) <= 7.815 ? 1 : 0;
    }
  }
  EXPECT_GT(refused, draws / 3);
  EXPECT_GE(inside, 0.85 * refused * asked) << "of draws that happen to tell little";
  EXPECT_LT(without, 0.70 * refused * asked);
}

}  // namespace brainshift::solve::smooth_motion_test
