// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/symmetric_eigen.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace brainshift::solve {

namespace {

/// The eigenvalue of a trace-free matrix that is farthest from the other two. Where these meet the arc cosine loses
/// half its digits, but its cosine, next to the top, does not feel that.
double distinct_eigenvalue(const Eigen::Matrix3d& m) {
  const double radius = std::sqrt(m.squaredNorm() / 6);
  const double determinant = m.col(0).dot(m.col(1).cross(m.col(2)));
  const double cosine = std::min(1.0, std::abs(determinant) / (2 * radius * radius * radius));
  return std::copysign(2 * radius * std::cos(std::acos(cosine) / 3), determinant);
}

/// The unit vector that a matrix of rank two maps to zero: across the two columns that span most.
Eigen::Vector3d null_vector(const Eigen::Matrix3d& m) {
  Eigen::Vector3d longest = m.col(0).cross(m.col(1));
  for (const Eigen::Vector3d& other : {m.col(1).cross(m.col(2)), m.col(2).cross(m.col(0))}) {
    if (other.squaredNorm() > longest.squaredNorm()) {
      longest = other;
    }
  }
  return longest.normalized();
}

}  // namespace

SymmetricEigen symmetric_eigen(const Eigen::Matrix3d& matrix) {
  const double mean = matrix.trace() / 3;
  Eigen::Matrix3d m = matrix - mean * Eigen::Matrix3d::Identity();
  const double size = m.cwiseAbs().sum();
  constexpr double negligible = 1e-300;  // below it the division by the size would overflow
  if (size <= negligible) {
    return {Eigen::Vector3d::Constant(mean), Eigen::Matrix3d::Identity()};
  }
  m /= size;

  SymmetricEigen result;
  const double distinct = distinct_eigenvalue(m);
  const Eigen::Vector3d axis = null_vector(m - distinct * Eigen::Matrix3d::Identity());
  const Eigen::Vector3d u = axis.unitOrthogonal();
  const Eigen::Vector3d v = axis.cross(u);

  const Eigen::Vector3d mv = m * v;
  const double uu = u.dot(m * u);
  const double uv = u.dot(mv);
  const double vv = v.dot(mv);
  const double half = (vv - uu) / 2;
  // the entries are of order one: an off-diagonal one of 1e-30 is none, and its square would underflow
  const double tangent = std::abs(uv) > 1e-30 ? uv / (half + std::copysign(std::sqrt(half * half + uv * uv), half)) : 0;
  const double cosine = 1 / std::sqrt(1 + tangent * tangent);
  const double sine = cosine * tangent;

  result.values = (size * Eigen::Vector3d(distinct, uu - tangent * uv, vv + tangent * uv)).array() + mean;
  result.vectors << axis, cosine * u - sine * v, sine * u + cosine * v;
  return result;
}

}  // namespace brainshift::solve
