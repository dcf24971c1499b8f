// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "segmentation/geometry/on_device.hpp"

namespace brainshift::solve {

namespace of_symmetric {

/// det / (2 r³) of a trace-free matrix, r² = |m|²/6: the cosine of three times the angle of its eigenvalues, which are
/// 2r cos(φ + 2πk/3).
struct Angle {
  double radius, cosine;

  BRAINSHIFT_ON_DEVICE explicit Angle(const Eigen::Matrix3d& m) : radius(std::sqrt(m.squaredNorm() / 6)) {
    const double determinant = m.col(0).dot(m.col(1).cross(m.col(2)));
    cosine = radius > 0 ? determinant / (2 * radius * radius * radius) : 1;
  }
};

/// The eigenvalue of a trace-free matrix that is farthest from the other two. Where these meet the arc cosine loses
/// half its digits, but its cosine, next to the top, does not feel that.
BRAINSHIFT_ON_DEVICE inline double distinct_eigenvalue(const Eigen::Matrix3d& m) {
  const Angle angle(m);
  const double cosine = std::min(1.0, std::abs(angle.cosine));
  return std::copysign(2 * angle.radius * std::cos(std::acos(cosine) / 3), angle.cosine);
}

/// The unit vector that a matrix of rank two maps to zero: across the two columns that span most.
BRAINSHIFT_ON_DEVICE inline Eigen::Vector3d null_vector(const Eigen::Matrix3d& m) {
  Eigen::Vector3d longest = m.col(0).cross(m.col(1));
  for (int k = 1; k < 3; ++k) {
    const Eigen::Vector3d other = m.col(k).cross(m.col((k + 1) % 3));
    if (other.squaredNorm() > longest.squaredNorm()) {
      longest = other;
    }
  }
  return longest.normalized();
}

}  // namespace of_symmetric

/// Eigenvalues of a symmetric (3 × 3) matrix, ascending, in closed form: off by 1e-8 where they meet, which is enough
/// for a bound. A NaN gives NaN.
BRAINSHIFT_ON_DEVICE inline Eigen::Vector3d symmetric_eigenvalues(const Eigen::Matrix3d& matrix) {
  constexpr double third_of_turn = 2.0943951023931954923;
  const double mean = matrix.trace() / 3;
  const Eigen::Matrix3d m = matrix - mean * Eigen::Matrix3d::Identity();
  const double size = m.cwiseAbs().sum();
  constexpr double negligible = 1e-300;  // below it the division by the size would overflow
  if (size <= negligible) {
    return Eigen::Vector3d::Constant(mean);
  }
  const of_symmetric::Angle angle(m / size);
  const double phi = std::acos(std::max(std::min(angle.cosine, 1.0), -1.0)) / 3;
  const double largest = 2 * angle.radius * std::cos(phi), smallest = 2 * angle.radius * std::cos(phi + third_of_turn);
  return (size * Eigen::Vector3d(smallest, -largest - smallest, largest)).array() + mean;
}

struct SymmetricEigen {
  Eigen::Vector3d values;   ///< in no particular order
  Eigen::Matrix3d vectors;  ///< columns, orthonormal
};

/// Eigenvalues and eigenvectors of a symmetric (3 × 3) matrix to rounding error, equal eigenvalues included: the one
/// that is farthest from the other two in closed form, then the remaining pair by one rotation. A NaN gives NaN.
/// Scherzinger & Dohrmann 2008 (Comput. Methods Appl. Mech. Engrg. 197:4007). Eigen's computeDirect is as fast, but
/// off by 1e-8 where eigenvalues meet, which is the state of rest; its iterative compute takes 2.5 times as long.
BRAINSHIFT_ON_DEVICE inline SymmetricEigen symmetric_eigen(const Eigen::Matrix3d& matrix) {
  const double mean = matrix.trace() / 3;
  Eigen::Matrix3d m = matrix - mean * Eigen::Matrix3d::Identity();
  const double size = m.cwiseAbs().sum();
  constexpr double negligible = 1e-300;  // below it the division by the size would overflow
  if (size <= negligible) {
    return {Eigen::Vector3d::Constant(mean), Eigen::Matrix3d::Identity()};
  }
  m /= size;

  SymmetricEigen result;
  const double distinct = of_symmetric::distinct_eigenvalue(m);
  const Eigen::Vector3d axis = of_symmetric::null_vector(m - distinct * Eigen::Matrix3d::Identity());
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
