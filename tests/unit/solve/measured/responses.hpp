// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "solve/measured/gaussian.hpp"
#include "solve/measured/response.hpp"

namespace brainshift::solve::test_responses {

/// Points whose displacements are alike over 40 mm, each component for itself.
inline Response smooth_response(const Points& places) {
  const Eigen::Index m = places.rows();
  Response response{Eigen::MatrixXd::Zero(3 * m, 3 * m), Eigen::MatrixXd(3 * m, 0), false};
  for (Eigen::Index a = 0; a < m; ++a) {
    for (Eigen::Index b = 0; b < m; ++b) {
      const double near = std::exp(-(places.row(a) - places.row(b)).squaredNorm() / (2 * 40 * 40));
      response.compliance.block<3, 3>(3 * a, 3 * b).diagonal().setConstant(1e-3 * near);
    }
  }
  return response;
}

inline Eigen::VectorXd normals(Eigen::Index size, std::mt19937& random) {
  std::normal_distribution<double> normal;
  Eigen::VectorXd values(size);
  for (double& value : values) {
    value = normal(random);
  }
  return values;
}

/// Drawn from the prior of weight s.
inline Points drawn(const Response& response, double s, std::mt19937& random) {
  Eigen::MatrixXd covariance = s * response.compliance;
  covariance.diagonal().array() += 1e-9 * covariance.diagonal().mean();
  const Eigen::VectorXd u = covariance.llt().matrixL() * normals(covariance.rows(), random);
  return Eigen::Map<const Points>(u.data(), u.size() / 3, 3);
}

/// Places that answer forces by themselves alone, and that a smooth motion moves as it is.
inline Response rough_response(const Points& places) {
  const Eigen::Index size = places.size();
  return {.compliance = 1e-3 * Eigen::MatrixXd::Identity(size, size),
          .rigid = Eigen::MatrixXd(size, 0),
          .sites = places,
          .carry = Eigen::MatrixXd::Identity(size, size)};
}

/// Drawn from a smooth motion, and a little of the rough one.
inline Points smoothly_drawn(const Response& response, const SmoothMotion& smooth, std::mt19937& random) {
  Eigen::MatrixXd covariance =
      Prior(response, 1 / millijoule, smooth).between(0, response.compliance.rows(), 0, response.compliance.rows());
  const Eigen::VectorXd u = covariance.llt().matrixL() * normals(covariance.rows(), random);
  return Eigen::Map<const Points>(u.data(), u.size() / 3, 3);
}

}  // namespace brainshift::solve::test_responses
