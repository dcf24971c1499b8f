// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <cmath>

#include "solve/material/material.hpp"

namespace brainshift::solve {

/// What a law needs of the deformation gradient at a point.
struct Deformation {
  Eigen::Matrix3d gradient;  ///< F
  Eigen::Matrix3d cofactor;  ///< J F⁻ᵀ = ∂J/∂F
  double jacobian;           ///< J = det F

  explicit Deformation(const Eigen::Matrix3d& f) : gradient(f) {
    cofactor.col(0) = f.col(1).cross(f.col(2));
    cofactor.col(1) = f.col(2).cross(f.col(0));
    cofactor.col(2) = f.col(0).cross(f.col(1));
    jacobian = f.col(0).dot(cofactor.col(0));
  }
};

/// Neo-Hookean, W = µ/2 (Ī1 − 3) + K/2 (J − 1)², Ī1 = J^(−2/3) tr FᵀF: ABAQUS's and CalculiX's NEO HOOKE with C10 =
/// µ/2, D1 = 2/K.
struct NeoHookean {
  double shear_modulus;  ///< µ, Pa
  double bulk_modulus;   ///< K, Pa

  explicit NeoHookean(const Material& m)
      : shear_modulus(m.youngs_modulus / (2 * (1 + m.poisson_ratio))),
        bulk_modulus(m.youngs_modulus / (3 * (1 - 2 * m.poisson_ratio))) {}

  /// ∂W/∂F without the volumetric part, Pa. J must be positive.
  Eigen::Matrix3d isochoric_stress(const Deformation& d) const {
    const double scale = shear_modulus * std::pow(d.jacobian, -2.0 / 3.0);
    return scale * (d.gradient - d.gradient.squaredNorm() / (3 * d.jacobian) * d.cofactor);
  }
  double isochoric_energy(const Deformation& d) const {
    return shear_modulus / 2 * (std::pow(d.jacobian, -2.0 / 3.0) * d.gradient.squaredNorm() - 3);
  }
  /// U(J) = K/2 (J − 1)² and p = U'(J), Pa. With mean dilatation J is the patch's.
  double pressure(double jacobian) const { return bulk_modulus * (jacobian - 1); }
  double volumetric_energy(double jacobian) const { return bulk_modulus / 2 * (jacobian - 1) * (jacobian - 1); }

  /// λ + 2µ of small strains, Pa: ρ c_d².
  double wave_modulus() const { return bulk_modulus + 4 * shear_modulus / 3; }
};

/// Largest eigenvalue of the tangent ∂²W/∂F∂F, Pa, at principal stretches (all > 0) with pressure p = U'(J) and U'' =
/// K. In principal axes the tangent falls into one 3 × 3 block (stretches) and, for each pair of axes, the two values
/// of the shear block (W_i ∓ W_j)/(λ_i ∓ λ_j).
double largest_tangent(const NeoHookean& law, const Eigen::Vector3d& stretch, double pressure);

}  // namespace brainshift::solve
