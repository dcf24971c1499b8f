// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace brainshift::solve {

/// Principal stretches λ_i of a deformation gradient, ascending, to 1e-8; at least 1e-4, so that a point about to
/// turn inside out has a huge tangent and not an infinite one.
Eigen::Vector3d principal_stretches(const Eigen::Matrix3d& gradient);

/// Derivatives of an isotropic energy W(λ1, λ2, λ3).
struct StretchDerivatives {
  Eigen::Vector3d first;   ///< W_i, Pa
  Eigen::Matrix3d second;  ///< W_ij, Pa
};

/// Adds the derivatives of U(J) with U' = p and U'' = K.
void add_volume_change(double bulk_modulus, double pressure, const Eigen::Vector3d& stretch,
                       StretchDerivatives& energy);

/// Largest eigenvalue of ∂²W/∂F∂F, Pa. In principal axes this tangent falls into the (3 × 3) block W_ij of the
/// stretches and, for each pair of axes, the two values (W_i ∓ W_j)/(λ_i ∓ λ_j) (Ogden 1984, Non-linear Elastic
/// Deformations, section 6.1); the first of them tends to W_ii − W_ij where the stretches are equal.
double largest_tangent(const StretchDerivatives& energy, const Eigen::Vector3d& stretch);

}  // namespace brainshift::solve
