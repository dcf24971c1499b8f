// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/measured/surprise.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "segmentation/geometry/quantile.hpp"
#include "solve/load/contradictions.hpp"
#include "solve/measured/gaussian.hpp"
#include "solve/measured/weight.hpp"

namespace brainshift::solve {

namespace {

double biweight(double r) {
  constexpr double c = 5.49;  // of three components; of one it is the usual 4.685
  const double in = 1 - std::min(1.0, r * r / (c * c));
  return in * in;
}

}  // namespace

/// The residual of leaving a point out is P_ii⁻¹ (P d)_i; its covariance is P_ii⁻¹ less what the variance was raised
/// by.
Eigen::VectorXd surprise(const Response& response, const Points& displacement, const Points& sigma,
                         const Points& weighed, const MeasuredFit& fit) {
  const Eigen::VectorXd variance = stacked_rows(weighed).cwiseAbs2();
  const Eigen::VectorXd raised = variance - stacked_rows(sigma).cwiseAbs2();
  const Eigen::Index m = variance.size();
  const Prior prior(response, fit.weight, fit.smooth);
  const MeasuredGaussian measured(prior.between(0, m, 0, m), response.rigid.topRows(m), stacked_rows(displacement),
                                  variance);
  const Eigen::MatrixXd p = measured.precision();
  Eigen::VectorXd result(m / 3);
  for (Eigen::Index i = 0; i < m / 3; ++i) {
    Eigen::Matrix3d covariance = p.block<3, 3>(3 * i, 3 * i).inverse();
    const Eigen::Vector3d off = covariance * measured.push.segment<3>(3 * i);
    covariance.diagonal() -= raised.segment<3>(3 * i);
    result[i] = std::sqrt(std::max(0.0, off.dot(covariance.ldlt().solve(off))));
  }
  return result;
}

Trust robust_trust(const Response& response, const Points& displacement, const Points& sigma, double weight) {
  constexpr int most_rounds = 50;
  constexpr double settled = 0.01;
  Trust trust{.weight = Eigen::VectorXd::Ones(displacement.rows()), .surprise = {}};
  for (int round = 0; round < most_rounds; ++round) {
    const Points weighed = sigma.array().colwise() / trust.weight.array().sqrt();
    const MeasuredFit fit = choose_weight(response, displacement, weighed, weight);
    const Eigen::VectorXd off = surprise(response, displacement, sigma, weighed, fit);
    trust.surprise = off / std::max(1.0, median(std::vector(off.begin(), off.end())) / usual_surprise);
    const Eigen::VectorXd next = trust.surprise.unaryExpr([](double r) { return std::max(least_trust, biweight(r)); });
    const double moved = (next - trust.weight).cwiseAbs().maxCoeff();
    trust.weight = next;
    if (moved < settled) {
      break;
    }
  }
  return trust;
}

}  // namespace brainshift::solve
