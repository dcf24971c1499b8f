// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/measured/gaussian.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>
#include <limits>

namespace brainshift::solve {

namespace {

double log_determinant(const Eigen::LLT<Eigen::MatrixXd>& factor) {
  return 2 * factor.matrixLLT().diagonal().array().log().sum();
}

Eigen::Matrix3d sizes_of(const SmoothMotion& smooth) {
  const Eigen::Matrix3d along = smooth.direction * smooth.direction.transpose();
  return smooth.along * smooth.along * along + smooth.across * smooth.across * (Eigen::Matrix3d::Identity() - along);
}

/// squared: r².
double how_alike(double squared, Alike alike) {
  if (alike == Alike::squared_exponential) {
    return std::exp(-squared / 2);
  }
  const double r = std::sqrt(5 * squared);
  return (1 + r + r * r / 3) * std::exp(-r);
}

}  // namespace

Eigen::MatrixXd smooth_covariance(const Response& response, const SmoothMotion& smooth, const Eigen::Matrix3d& sizes,
                                  Alike alike) {
  const Points& sites = response.sites;
  const Eigen::VectorXd left = smooth.fades ? response.fading : Eigen::VectorXd::Ones(sites.rows());
  Eigen::MatrixXd covariance(3 * sites.rows(), 3 * sites.rows());
  for (Eigen::Index i = 0; i < sites.rows(); ++i) {
    for (Eigen::Index j = 0; j < sites.rows(); ++j) {
      const double squared = (sites.row(i) - sites.row(j)).squaredNorm() / (smooth.length * smooth.length);
      covariance.block<3, 3>(3 * i, 3 * j) = left[i] * left[j] * how_alike(squared, alike) * sizes;
    }
  }
  return covariance;
}

Eigen::VectorXd fading_to_rim(const Points& sites) {
  constexpr double at_rim = 0.1;
  const Points away = sites.rowwise() - sites.colwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(away.transpose() * away /
                                                            static_cast<double>(sites.rows()));
  Eigen::VectorXd squared = Eigen::VectorXd::Zero(sites.rows());  // of the distance, over the extent there
  for (const int axis : {1, 2}) {                                 // in the plane of the opening
    if (const double extent = axes.eigenvalues()[axis]; extent > 0) {
      squared += (away * axes.eigenvectors().col(axis)).cwiseAbs2() / extent;
    }
  }
  const double rim = squared.maxCoeff();
  return rim > 0 ? Eigen::VectorXd(1 - (1 - at_rim) * (squared / rim).array()) : Eigen::VectorXd::Ones(sites.rows());
}

Prior::Prior(const Response& response, double weight, const SmoothMotion& smooth, Alike alike)
    : response_(response), weight_(millijoule * weight) {
  if (smooth.length > 0) {
    smooth_ = smooth_covariance(response, smooth, sizes_of(smooth), alike);
  }
}

Eigen::MatrixXd Prior::between(Eigen::Index first, Eigen::Index rows, Eigen::Index other, Eigen::Index columns) const {
  Eigen::MatrixXd covariance = weight_ * response_.compliance.block(first, other, rows, columns);
  if (smooth_.size() > 0) {
    const Eigen::MatrixXd carried = response_.carry.middleRows(first, rows) * smooth_;
    covariance += carried * response_.carry.middleRows(other, columns).transpose();
  }
  return covariance;
}

Eigen::MatrixXd independent(const Eigen::MatrixXd& columns) {
  constexpr double none = 0.02;
  if (columns.cols() == 0) {
    return columns;
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> parts(columns);
  parts.setThreshold(none);
  return parts.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), parts.rank());
}

MeasuredGaussian::MeasuredGaussian(Eigen::MatrixXd prior, Eigen::MatrixXd rigid, const Eigen::VectorXd& d,
                                   const Eigen::VectorXd& variance) {
  prior.diagonal() += variance;
  factor_.compute(prior);
  inverse_rigid_ = factor_.solve(rigid);
  normal_.compute(rigid.transpose() * inverse_rigid_);
  motion = rigid.cols() > 0 ? normal_.solve(inverse_rigid_.transpose() * d).eval() : Eigen::VectorXd();
  push = factor_.solve(d - rigid * motion);
  squares = d.dot(push);
  const double log_rigid = rigid.cols() > 0 ? log_determinant(normal_) : 0;
  log_likelihood = factor_.info() == Eigen::Success ? -(squares + log_determinant(factor_) + log_rigid) / 2
                                                    : -std::numeric_limits<double>::infinity();
}

Eigen::VectorXd MeasuredGaussian::motion_deviation() const {
  const Eigen::Index n = motion.size();
  return n > 0 ? normal_.solve(Eigen::MatrixXd::Identity(n, n)).diagonal().cwiseSqrt().eval() : Eigen::VectorXd();
}

Eigen::MatrixXd MeasuredGaussian::covariance(const Eigen::MatrixXd& own, const Eigen::MatrixXd& cross,
                                             const Eigen::MatrixXd& their_rigid) const {
  Eigen::MatrixXd result = own - cross * factor_.solve(cross.transpose());
  if (motion.size() > 0) {
    const Eigen::MatrixXd left = their_rigid - cross * inverse_rigid_;
    result += left * normal_.solve(left.transpose());
  }
  return result;
}

Eigen::MatrixXd MeasuredGaussian::precision() const {
  const Eigen::Index m = push.size();
  Eigen::MatrixXd p = factor_.solve(Eigen::MatrixXd::Identity(m, m));
  if (motion.size() > 0) {
    p -= inverse_rigid_ * normal_.solve(inverse_rigid_.transpose());
  }
  return p;
}

}  // namespace brainshift::solve
