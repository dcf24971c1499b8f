// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/measured/weight.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace brainshift::solve {

namespace {

constexpr double millijoule = 1e6;  // µN mm
constexpr int candidates = 41;

double log_determinant(const Eigen::LLT<Eigen::MatrixXd>& factor) {
  return 2 * factor.matrixLLT().diagonal().array().log().sum();
}

/// The points as Gaussians under one weight.
class Gaussian {
 public:
  Gaussian(const Response& response, const Eigen::VectorXd& d, const Eigen::VectorXd& variance, double weight)
      : response_(response), variance_(variance), weight_(weight) {
    const Eigen::Index m = d.size();
    Eigen::MatrixXd covariance = weight * response.compliance.topLeftCorner(m, m);
    covariance.diagonal() += variance;
    factor_.compute(covariance);
    const Eigen::MatrixXd rigid = response.rigid.topRows(m);
    inverse_rigid_ = factor_.solve(rigid);
    normal_.compute(rigid.transpose() * inverse_rigid_);
    motion = rigid.cols() > 0 ? normal_.solve(inverse_rigid_.transpose() * d).eval() : Eigen::VectorXd();
    push = factor_.solve(d - rigid * motion);
    squares = d.dot(push);
  }

  WeightRow row() const {
    const Eigen::Index m = push.size();
    const double log_rigid = motion.size() > 0 ? log_determinant(normal_) : 0;
    const auto answer = response_.compliance.topLeftCorner(m, m);
    return {.weight = weight_ / millijoule,
            .misfit = push.cwiseAbs2().dot(variance_),
            .energy = weight_ * weight_ * push.dot(answer * push) / 2 / millijoule,
            .log_likelihood = -(squares + log_determinant(factor_) + log_rigid) / 2};
  }

  Eigen::VectorXd motion_deviation() const {
    const Eigen::Index n = motion.size();
    return n > 0 ? normal_.solve(Eigen::MatrixXd::Identity(n, n)).diagonal().cwiseSqrt().eval() : Eigen::VectorXd();
  }

  /// Of `size` components of displacements behind the measured ones, from `first` on, in the frame of the image: of a
  /// body that is held the rigid motion is the patient's, not the brain's.
  Eigen::MatrixXd covariance(Eigen::Index first, Eigen::Index size, bool motion_is_of_body) const {
    const Eigen::Index m = push.size();
    const Eigen::MatrixXd cross = weight_ * response_.compliance.block(first, 0, size, m);
    Eigen::MatrixXd result =
        weight_ * response_.compliance.block(first, first, size, size) - cross * factor_.solve(cross.transpose());
    if (motion.size() > 0) {
      Eigen::MatrixXd left = -cross * inverse_rigid_;
      if (motion_is_of_body) {
        left += response_.rigid.middleRows(first, size);
      }
      result += left * normal_.solve(left.transpose());
    }
    return result;
  }

  /// Of each measured point the residual of leaving it out, P_ii⁻¹ (P d)_i, whose covariance is P_ii⁻¹; less what its
  /// variance was raised by.
  Eigen::VectorXd surprise(const Eigen::VectorXd& raised) const {
    const Eigen::Index m = push.size();
    Eigen::MatrixXd p = factor_.solve(Eigen::MatrixXd::Identity(m, m));
    if (motion.size() > 0) {
      p -= inverse_rigid_ * normal_.solve(inverse_rigid_.transpose());
    }
    Eigen::VectorXd result(m / 3);
    for (Eigen::Index i = 0; i < m / 3; ++i) {
      Eigen::Matrix3d covariance = p.block<3, 3>(3 * i, 3 * i).inverse();
      const Eigen::Vector3d left_out = covariance * push.segment<3>(3 * i);
      covariance.diagonal() -= raised.segment<3>(3 * i);
      result[i] = std::sqrt(std::max(0.0, left_out.dot(covariance.ldlt().solve(left_out))));
    }
    return result;
  }

  Eigen::VectorXd motion;  ///< mm
  Eigen::VectorXd push;    ///< P d, 1/mm
  double squares = 0;      ///< dᵀ P d

 private:
  const Response& response_;
  const Eigen::VectorXd& variance_;
  double weight_;  // s, µN mm
  Eigen::LLT<Eigen::MatrixXd> factor_, normal_;
  Eigen::MatrixXd inverse_rigid_;
};

double median(const Eigen::VectorXd& values) {
  std::vector<double> sorted(values.begin(), values.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

double biweight(double r) {
  constexpr double c = 5.49;  // of three components; of one it is the usual 4.685
  const double in = 1 - std::min(1.0, r * r / (c * c));
  return in * in;
}

}  // namespace

MeasuredFit choose_weight(const Response& response, const Points& displacement, const Points& sigma, double weight) {
  const Eigen::VectorXd d = Eigen::Map<const Eigen::VectorXd>(displacement.data(), displacement.size());
  const Eigen::VectorXd variance = Eigen::Map<const Eigen::VectorXd>(sigma.data(), sigma.size()).cwiseAbs2();
  const Eigen::Index m = d.size();
  const double freedom = static_cast<double>(m - response.rigid.cols());
  if (freedom <= 0) {
    throw std::invalid_argument("load: " + std::to_string(displacement.rows()) +
                                " measured points do not tell a motion of the whole from noise; measure three or more");
  }
  const double answer = response.compliance.diagonal().head(m).mean();
  const double least = 0.1 * sigma.mean(), most = std::max(10 * displacement.cwiseAbs().maxCoeff(), 2 * least);
  const double low = least * least / answer, high = most * most / answer;
  MeasuredFit fit;
  double best = -std::numeric_limits<double>::infinity();
  fit.weight = weight;
  for (int i = 0; i < candidates && weight == 0; ++i) {
    const double s = low * std::pow(high / low, static_cast<double>(i) / (candidates - 1));
    fit.weights.push_back(Gaussian(response, d, variance, s).row());
    if (fit.weights.back().log_likelihood > best) {
      best = fit.weights.back().log_likelihood;
      fit.weight = fit.weights.back().weight;
    }
  }
  const Gaussian chosen(response, d, variance, millijoule * fit.weight);
  constexpr double given = 3;  // what was given of the noise counts as much as one measured point
  const double factor = (given + chosen.squares) / (given + freedom);
  fit.noise_factor = std::sqrt(factor);
  fit.motion = chosen.motion;
  fit.motion_deviation = fit.noise_factor * chosen.motion_deviation();
  const Eigen::Index asked = (response.compliance.rows() - m) / 3;
  fit.covariance.resize(asked, 6);
  for (Eigen::Index a = 0; a < asked; ++a) {
    fit.covariance.row(a) = six_entries(factor * chosen.covariance(m + 3 * a, 3, response.free));
  }
  return fit;
}

Eigen::VectorXd surprise(const Response& response, const Points& displacement, const Points& sigma, double weight) {
  const Eigen::VectorXd d = Eigen::Map<const Eigen::VectorXd>(displacement.data(), displacement.size());
  const Eigen::VectorXd variance = Eigen::Map<const Eigen::VectorXd>(sigma.data(), sigma.size()).cwiseAbs2();
  return Gaussian(response, d, variance, millijoule * weight).surprise(Eigen::VectorXd::Zero(d.size()));
}

Eigen::VectorXd robust_weights(const Response& response, const Points& displacement, const Points& sigma,
                               double weight) {
  constexpr int most_rounds = 50;
  constexpr double settled = 0.01;
  const Eigen::VectorXd d = Eigen::Map<const Eigen::VectorXd>(displacement.data(), displacement.size());
  const Eigen::VectorXd own = Eigen::Map<const Eigen::VectorXd>(sigma.data(), sigma.size()).cwiseAbs2();
  Eigen::VectorXd left = Eigen::VectorXd::Ones(displacement.rows());
  for (int round = 0; round < most_rounds; ++round) {
    const Points raised = sigma.array().colwise() / left.array().sqrt();
    const Eigen::VectorXd variance = Eigen::Map<const Eigen::VectorXd>(raised.data(), raised.size()).cwiseAbs2();
    const double s = choose_weight(response, displacement, raised, weight).weight;
    const Eigen::VectorXd off = Gaussian(response, d, variance, millijoule * s).surprise(variance - own);
    const double usual = std::max(1.0, median(off) / usual_surprise);
    const Eigen::VectorXd next = off.unaryExpr([&](double r) { return std::max(least_trust, biweight(r / usual)); });
    const double moved = (next - left).cwiseAbs().maxCoeff();
    left = next;
    if (moved < settled) {
      break;
    }
  }
  return left;
}

Eigen::MatrixXd posterior_covariance(const Response& response, const Points& sigma, const MeasuredFit& fit) {
  const Eigen::Index m = sigma.size(), rest = response.compliance.rows() - m;
  const Eigen::VectorXd variance = Eigen::Map<const Eigen::VectorXd>(sigma.data(), m).cwiseAbs2();
  const Gaussian posterior(response, Eigen::VectorXd::Zero(m), variance, millijoule * fit.weight);
  return fit.noise_factor * fit.noise_factor * posterior.covariance(m, rest, response.free);
}

Eigen::Matrix<double, 1, 6> six_entries(const Eigen::Matrix3d& c) {
  return {c(0, 0), c(1, 1), c(2, 2), c(0, 1), c(1, 2), c(2, 0)};
}

}  // namespace brainshift::solve
