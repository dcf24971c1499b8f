// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/measured/weight.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "solve/measured/gaussian.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/unit/solve/measured/responses.hpp"

namespace brainshift::solve::weight_test {

using test_responses::drawn;
using test_responses::normals;
using test_responses::rough_response;
using test_responses::smooth_response;
using test_responses::smoothly_drawn;

/// Places of a body that hardly deforms and that nothing holds.
Response stiff_and_free(const Points& places) {
  Response response = rough_response(places);
  response.compliance *= 1e-9;
  response.rigid = rigid_motions(places, places);
  response.free = true;
  response.sites = Points(0, 3);
  return response;
}

TEST(Weight, IsFoundFromDisplacementsThatWereDrawnWithIt) {
  std::mt19937 random(1);
  const Points places = test::random_points(40, 100);
  const Response response = smooth_response(places);
  for (const double s : {1e2, 1e4}) {  // µN mm: standard deviations of 0.3 and 3 mm
    double mean = 0;
    for (int draw = 0; draw < 5; ++draw) {
      const Points noise = Eigen::Map<const Points>(normals(120, random).data(), 40, 3);
      const MeasuredFit fit =
          choose_weight(response, drawn(response, s, random) + 0.2 * noise, Points::Constant(40, 3, 0.2));
      mean += std::log(millijoule * fit.weight / s) / 5;
      EXPECT_NEAR(fit.noise_factor, 1, 0.25);
    }
    EXPECT_LT(std::abs(mean), std::log(2)) << s;
  }
}

TEST(Weight, TradesMisfitAgainstEnergy) {
  std::mt19937 random(2);
  const Points places = test::random_points(20, 100);
  const Response response = smooth_response(places);
  const MeasuredFit fit = choose_weight(response, drawn(response, 1e4, random), Points::Constant(20, 3, 0.5));
  ASSERT_GT(fit.weights.size(), 10U);
  for (std::size_t i = 1; i < fit.weights.size(); ++i) {
    EXPECT_GT(fit.weights[i].weight, fit.weights[i - 1].weight);
    EXPECT_LE(fit.weights[i].misfit, fit.weights[i - 1].misfit);
    EXPECT_GE(fit.weights[i].energy, fit.weights[i - 1].energy);
  }
  const MeasuredFit given = choose_weight(response, drawn(response, 1e4, random), Points::Constant(20, 3, 0.5), 0.25);
  EXPECT_EQ(given.weight, 0.25);
  EXPECT_TRUE(given.weights.empty());
}

TEST(Weight, EllipsoidsHoldTheTruthAsOftenAsTheySay) {
  std::mt19937 random(3);
  constexpr int known = 15, asked = 10, draws = 40;
  const Points places = test::random_points(known + asked, 100);
  const Response response = smooth_response(places);
  int inside = 0;
  for (int draw = 0; draw < draws; ++draw) {
    const Points truth = drawn(response, 1e4, random);
    const Points noise = 0.5 * Eigen::Map<const Points>(normals(3 * known, random).data(), known, 3);
    const MeasuredFit fit = choose_weight(response, truth.topRows(known) + noise, Points::Constant(known, 3, 0.5));
    Eigen::MatrixXd v = millijoule * fit.weight * response.compliance.topLeftCorner(3 * known, 3 * known);
    v.diagonal().array() += 0.25;
    const Points measured = truth.topRows(known) + noise;
    const Eigen::VectorXd push = v.llt().solve(Eigen::Map<const Eigen::VectorXd>(measured.data(), 3 * known));
    const Posterior said(response, measured, Points::Constant(known, 3, 0.5), fit);
    for (int a = 0; a < asked; ++a) {
      const Eigen::Vector3d mean =
          millijoule * fit.weight * response.compliance.block(3 * (known + a), 0, 3, 3 * known) * push;
      const Eigen::Matrix3d covariance = said.covariance(a, 1);
      const Eigen::Vector3d error = truth.row(known + a).transpose() - mean;
      inside += error.dot(covariance.llt().solve(error)) <= 7.815 ? 1 : 0;
    }
  }
  EXPECT_GE(inside, 0.90 * draws * asked);
  EXPECT_LE(inside, 0.99 * draws * asked);
}

// What is said not to be known must say nothing, of the weight or of the noise.
TEST(Weight, DoesNotDependOnHowLittleAFewPointsTell) {
  std::mt19937 random(4);
  const Points places = test::random_points(30, 100);
  const Response response = rough_response(places);
  const Points noise = 0.3 * Eigen::Map<const Points>(normals(90, random).data(), 30, 3);
  const Points d = smoothly_drawn(response, {50, 4, 0.3, Eigen::Vector3d::UnitZ()}, random) + noise;
  Points sigma = Points::Constant(30, 3, 0.3);
  sigma.topRows(2).setConstant(30);
  sigma.row(5).head<2>().setConstant(30);
  const MeasuredFit some = choose_weight(response, d, sigma);
  sigma = (sigma.array() > 1).select(1e6, sigma);
  const MeasuredFit nothing = choose_weight(response, d, sigma);
  EXPECT_NEAR(nothing.weight, some.weight, 0.05 * some.weight);
  EXPECT_NEAR(nothing.smooth.along, some.smooth.along, 0.05 * some.smooth.along);
  EXPECT_NEAR(nothing.noise_factor, some.noise_factor, 0.02);
  EXPECT_NEAR(some.noise_factor, 1, 0.25);
  sigma.rightCols<2>().setConstant(30);  // one component alone is measured
  EXPECT_NEAR(choose_weight(response, d, sigma).noise_factor, 1, 0.4);
  sigma = (sigma.array() > 1).select(0.3, sigma);
  const double plain = choose_weight(response, d, sigma).noise_factor;
  sigma.row(9).setConstant(0.01);
  EXPECT_NEAR(choose_weight(response, d, sigma).noise_factor, plain, 0.25) << "nor on how much one tells";
  sigma.setConstant(0.3);
  sigma.rightCols<2>().setConstant(30);
  EXPECT_NEAR(choose_weight(response, d, sigma).noise_factor, 1, 0.4) << "one component alone is measured";
}

// Heights alone tell three of the six rigid motions: without the others in the count nothing is left of this one.
TEST(Weight, CountsTheRigidMotionsThatTheUsualComponentsTell) {
  std::mt19937 random(10);
  Points places = test::random_points(20, 60);
  places.col(2) *= 0.1;
  Response response = rough_response(places);
  response.rigid = rigid_motions(places, places);
  response.free = true;
  response.sites = Points(0, 3);
  Eigen::VectorXd turned(6);
  turned << 3, -4, 2, 1, -2, 1;
  Points sigma = Points::Constant(20, 3, 0.4);
  for (const double sideways : {1.15, 1.25}) {  // three times 0.4 counts as unusual
    sigma.leftCols<2>().setConstant(sideways);
    double mean = 0;
    for (int draw = 0; draw < 10; ++draw) {
      const Eigen::VectorXd noise = stacked_rows(sigma).cwiseProduct(normals(60, random));
      const Eigen::VectorXd d = response.rigid * turned + noise;
      mean += choose_weight(response, Eigen::Map<const Points>(d.data(), 20, 3), sigma).noise_factor / 10;
    }
    EXPECT_NEAR(mean, 1, 0.2) << sideways;
  }
}

/// Noise of twice what is said, at four points: 3 of what is said and 6 of χ², E (3 + 4 χ²) / (3 + 6) = 3.
TEST(Weight, CountsNoiseOverTheFreedomThatRigidMotionsLeave) {
  std::mt19937 random(10);
  constexpr int draws = 400;
  constexpr double said = 0.4;
  const Points sigma = Points::Constant(4, 3, said);
  const Response response = stiff_and_free(test::random_points(4, 60));
  double squares = 0;
  for (int draw = 0; draw < draws; ++draw) {
    const Eigen::VectorXd d = 2 * said * normals(12, random);
    const MeasuredFit fit = choose_weight(response, Eigen::Map<const Points>(d.data(), 4, 3), sigma, 1e-12);
    squares += fit.noise_factor * fit.noise_factor / draws;
    ASSERT_NEAR(fit.motion_deviation[0], fit.noise_factor * said / std::sqrt(4), 0.01 * fit.noise_factor);
  }
  EXPECT_NEAR(squares, 3, 0.3);
}

TEST(Weight, IsRefusedWherePointsOnALineAreAllThatHoldsABody) {
  Points line = Eigen::VectorXd::LinSpaced(8, 0, 50) * Eigen::RowVector3d(0.6, -0.48, 0.64);
  line = ((1000 * line).array().round() / 1000).eval();  // as a file has it
  Response response = rough_response(line);
  response.rigid = rigid_motions(line, line);
  response.free = true;
  const Points d = Points::Ones(8, 3), sigma = Points::Constant(8, 3, 0.5);
  EXPECT_NE(test::refusal([&] { choose_weight(response, d, sigma); }).find("one line"), std::string::npos);
  response.rigid.resize(24, 0);  // a skull
  EXPECT_NO_THROW(choose_weight(response, d, sigma));
}

// Where the registration is found beside it, what the brain moves alike under the opening looks the same.
TEST(Weight, AnUnknownRegistrationIsKnownNoBetterThanTheMotionThatItHides) {
  std::mt19937 random(5);
  const Points cap = test::random_points(20, 20);
  const Points d = 0.3 * Eigen::Map<const Points>(normals(60, random).data(), 20, 3),
               sigma = Points::Constant(20, 3, 0.3);
  Response response = rough_response(cap);
  response.rigid = rigid_motions(cap, cap);
  const MeasuredFit on_cortex = choose_weight(response, d, sigma);
  EXPECT_EQ(on_cortex.smooth.length, 0);
  EXPECT_GT(on_cortex.motion_deviation.head<3>().minCoeff(), 2.5);
  const Points twice = Points::Constant(20, 3, 0.15);  // noise that is twice what is given
  const MeasuredFit noisy = choose_weight(response, d, twice, 1e-9);
  EXPECT_GT(noisy.noise_factor, 1.3);
  EXPECT_NEAR(noisy.motion_deviation[0], on_cortex.motion_deviation[0], 0.3) << "what is hidden is no noise";
  response.carry.setZero();  // points that it does not move tell the two apart
  EXPECT_LT(choose_weight(response, d, sigma).motion_deviation.head<3>().maxCoeff(), 0.5);
}

/// An opening that sinks alike, and points inside that stay, as a tracker sees them that is off.
TEST(Weight, AnUnknownRegistrationIsFoundBesideTheMotionThatItHides) {
  std::mt19937 random(7);
  constexpr Eigen::Index of_cap = 20, inside = 8, all = of_cap + inside;
  Points places(all, 3);
  places << test::random_points(of_cap, 20), test::random_points(inside, 60);
  places.topRows(of_cap).col(2).array() += 60;
  Response response = rough_response(places);
  response.rigid = rigid_motions(places, places);
  response.sites = places.topRows(of_cap);
  response.carry = Eigen::MatrixXd::Identity(3 * all, 3 * of_cap);
  Eigen::VectorXd tracker(6);
  tracker << 3, -4, 2, 1, -2, 1;
  Eigen::VectorXd d = response.rigid * tracker + 0.1 * normals(3 * all, random);
  for (Eigen::Index p = 0; p < of_cap; ++p) {
    d[3 * p + 2] -= 5;
  }
  const MeasuredFit fit =
      choose_weight(response, Eigen::Map<const Points>(d.data(), all, 3), Points::Constant(all, 3, 0.1));
  EXPECT_LT((response.rigid * (fit.motion - tracker)).cwiseAbs().maxCoeff(), 0.7);
  EXPECT_LT(((fit.motion - tracker).cwiseAbs() - 3 * fit.motion_deviation).maxCoeff(), 0);
}

TEST(Posterior, MeasuresTheRigidMotionOfAFreeBodyAndLeavesThatOfAHeldOneOut) {
  std::mt19937 random(5);
  constexpr int known = 10, asked = 4;
  const Points places = test::random_points(known + asked, 100);
  Response response = smooth_response(places);
  response.rigid = rigid_motions(places, places);
  const Points sigma = Points::Constant(known, 3, 0.5), still = drawn(response, 1e4, random).topRows(known);
  const Eigen::VectorXd motion = response.rigid * Eigen::VectorXd::Constant(6, 3);
  const Points moved = still + Eigen::Map<const Points>(motion.data(), places.rows(), 3).topRows(known);
  for (const bool free : {false, true}) {
    response.free = free;
    const MeasuredFit fit = choose_weight(response, still, sigma);
    const Posterior one(response, still, sigma, fit), other(response, moved, sigma, fit);
    const Eigen::MatrixXd joint = one.covariance(0, asked);
    ASSERT_EQ(joint.rows(), 3 * asked);
    EXPECT_LT((joint - joint.transpose()).norm(), 1e-9 * joint.norm());
    for (int a = 0; a < asked; ++a) {
      EXPECT_LT((joint.block<3, 3>(3 * a, 3 * a) - one.covariance(a, 1)).norm(), 1e-9 * joint.norm());
    }
    const Points apart = Eigen::Map<const Points>(motion.data(), places.rows(), 3).bottomRows(asked);
    EXPECT_LT((other.mean() - one.mean() - (free ? 1 : 0) * apart).norm(), 1e-6);
  }
}

TEST(Posterior, OfAStiffFreeBodyIsKnownNoBetterThanItsRigidMotion) {
  constexpr int known = 5;
  constexpr double said = 0.4;
  Points places(known + 1, 3);
  places.topRows(known) = test::random_points(known, 60);
  places.row(known) = places.topRows(known).colwise().mean();
  Response response = stiff_and_free(places);
  response.rigid = rigid_motions(places, places.topRows(known));
  MeasuredFit fit;
  fit.weight = 1e-12;
  const Posterior posterior(response, Points::Zero(known, 3), Points::Constant(known, 3, said), fit);
  const Eigen::Matrix3d expected = said * said / known * Eigen::Matrix3d::Identity();
  EXPECT_LT((posterior.covariance(0, 1) - expected).norm(), 1e-6);
}

TEST(MeasuredGaussian, HasTheLikelihoodOfTheFreedomThatRigidMotionsLeave) {
  const Points places = test::random_points(4, 60);
  const auto log_likelihood = [&](double variance) {
    return MeasuredGaussian(Eigen::MatrixXd::Zero(12, 12), rigid_motions(places, places), Eigen::VectorXd::Zero(12),
                            Eigen::VectorXd::Constant(12, variance))
        .log_likelihood;
  };
  EXPECT_NEAR(log_likelihood(4) - log_likelihood(1), -(12 - 6) * std::log(4.0) / 2, 1e-9);
}

TEST(AsSaid, IsTheMeanOfTheCovarianceAndTheBallAboutItAndSmallerWhereTheAnswerIs) {
  const Eigen::Matrix3d c = Eigen::Vector3d(0.01, 0.04, 0.09).asDiagonal();
  const Eigen::RowVector3d u(3, 0, 4);
  EXPECT_LT((as_said(six_entries(c), u, u) - SixEntries(0.05, 0.065, 0.09, 0, 0, 0)).norm(), 1e-12);
  const SixEntries half = as_said(six_entries(c), u, u / 2);
  EXPECT_GT(half[2], 0.09 / 4);
  EXPECT_LT(half[2], 0.09 / 3) << "what is no larger than the error hardly counts";
  EXPECT_LT((as_said(six_entries(c), 2e-6 * u, 1e-6 * u) - as_said(six_entries(c), u, u)).norm(), 1e-5);
  EXPECT_EQ(as_said(six_entries(c), u, 2 * u), as_said(six_entries(c), u, u));
  EXPECT_EQ(as_said(SixEntries::Zero(), u, u), SixEntries::Zero());
}

TEST(Weight, FindsARigidMotionBesideTheDeformation) {
  std::mt19937 random(4);
  const Points places = test::random_points(12, 100);
  Response response = smooth_response(places);
  response.compliance *= 1e-3;
  response.rigid = rigid_motions(places, places);
  Eigen::VectorXd motion(6);
  motion << 3, -2, 1, 0.5, 0, -1;
  const Eigen::VectorXd moved = response.rigid * motion;
  const Points d = Eigen::Map<const Points>(moved.data(), 12, 3);
  const MeasuredFit fit = choose_weight(response, d, Points::Constant(12, 3, 0.5));
  EXPECT_LT((fit.motion - motion).norm(), 1e-6);
  EXPECT_GT(fit.motion_deviation.minCoeff(), 0);
}

TEST(Weight, IsRefusedWherePointsDoNotFixARigidMotion) {
  const Points places = test::random_points(2, 100);
  Response response = smooth_response(places);
  response.rigid = rigid_motions(places, places);
  EXPECT_NE(
      test::refusal([&] { choose_weight(response, Points::Ones(2, 3), Points::Ones(2, 3)); }).find("three or more"),
      std::string::npos);
}

}  // namespace brainshift::solve::weight_test
