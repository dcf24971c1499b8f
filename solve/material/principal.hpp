// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "solve/material/deformation.hpp"
#include "solve/material/symmetric_eigen.hpp"

namespace brainshift::solve {

/// Principal stretches λ_i of a deformation gradient, ascending, to 1e-8; at least 1e-4, so that a point about to
/// turn inside out has a huge tangent and not an infinite one.
BRAINSHIFT_ON_DEVICE inline Eigen::Vector3d principal_stretches(const Eigen::Matrix3d& gradient) {
  const Eigen::Vector3d strain = symmetric_eigenvalues(green_lagrange(gradient));
  return (1 + 2 * strain.array()).max(1e-8).sqrt();
}

/// Derivatives of an isotropic energy W(λ1, λ2, λ3).
struct StretchDerivatives {
  Eigen::Vector3d first;   ///< W_i, Pa
  Eigen::Matrix3d second;  ///< W_ij, Pa
};

/// Adds the derivatives of U(J) with U' = p and U'' = K.
BRAINSHIFT_ON_DEVICE inline void add_volume_change(double bulk_modulus, double pressure, const Eigen::Vector3d& stretch,
                                                   StretchDerivatives& energy) {
  const double jacobian = stretch.prod();
  const Eigen::Vector3d slope = jacobian * stretch.cwiseInverse();
  energy.first += pressure * slope;
  energy.second += (bulk_modulus + pressure / jacobian) * slope * slope.transpose();
  energy.second.diagonal() -= pressure / jacobian * slope.cwiseAbs2();
}

/// Largest eigenvalue of ∂²W/∂F∂F, Pa. In principal axes this tangent falls into the (3 × 3) block W_ij of the
/// stretches and, for each pair of axes, the two values (W_i ∓ W_j)/(λ_i ∓ λ_j) (Ogden 1984, Non-linear Elastic
/// Deformations, section 6.1); the first of them tends to W_ii − W_ij where the stretches are equal.
BRAINSHIFT_ON_DEVICE inline double largest_tangent(const StretchDerivatives& energy, const Eigen::Vector3d& stretch) {
  double largest = symmetric_eigenvalues(energy.second)[2];
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const double sum = stretch[i] + stretch[j];
    const double difference = stretch[i] - stretch[j];
    // as W is even in the difference, the mean of the two limits is right to its second order
    const double shear = std::abs(difference) > 1e-5 * sum
                             ? (energy.first[i] - energy.first[j]) / difference
                             : (energy.second(i, i) + energy.second(j, j)) / 2 - energy.second(i, j);
    largest = std::max(std::max(largest, shear), (energy.first[i] + energy.first[j]) / sum);
  }
  return largest;
}

}  // namespace brainshift::solve
