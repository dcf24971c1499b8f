// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "solve/material/deformation.hpp"
#include "solve/material/material.hpp"
#include "solve/material/principal.hpp"

namespace brainshift::solve {

/// Neo-Hookean, W = µ/2 (Ī1 − 3) + K/2 (J − 1)², Ī1 = J^(−2/3) tr FᵀF: ABAQUS's and CalculiX's NEO HOOKE with C10 =
/// µ/2, D1 = 2/K. J must be positive.
struct NeoHookean {
  static constexpr double least_dilatation = -1;  ///< θ where J = 0

  double shear_modulus;  ///< µ, Pa
  double bulk_modulus;   ///< K, Pa

  explicit NeoHookean(const Material& m)
      : shear_modulus(solve::shear_modulus(m)), bulk_modulus(solve::bulk_modulus(m)) {}

  /// ∂W/∂F without the volumetric part, Pa.
  BRAINSHIFT_ON_DEVICE Eigen::Matrix3d isochoric_stress(const Deformation& d) const {
    const double scale = shear_modulus * to_minus_two_thirds(d.jacobian);
    return scale * (d.gradient - d.gradient.squaredNorm() / (3 * d.jacobian) * d.cofactor);
  }
  /// µ/2 (Ī1 − 3), Pa.
  BRAINSHIFT_ON_DEVICE double isochoric_energy(const Deformation& d) const {
    return shear_modulus / 2 * (to_minus_two_thirds(d.jacobian) * d.gradient.squaredNorm() - 3);
  }
  /// θ = J − 1 and ∂θ/∂F.
  BRAINSHIFT_ON_DEVICE double dilatation(const Deformation& d) const { return d.jacobian - 1; }
  BRAINSHIFT_ON_DEVICE Eigen::Matrix3d dilatation_slope(const Deformation& d) const { return d.cofactor; }
};

/// Largest eigenvalue of the tangent ∂²W/∂F∂F at F, Pa, with the pressure p given, as a patch shares it, and U'' = K.
BRAINSHIFT_ON_DEVICE inline double largest_tangent(const NeoHookean& law, const Eigen::Matrix3d& gradient,
                                                   double pressure) {
  const Eigen::Vector3d stretch = principal_stretches(gradient);
  const double scale = law.shear_modulus / std::pow(stretch.prod(), 2.0 / 3.0);
  const double third = stretch.squaredNorm() / 3;
  const Eigen::Vector3d inverse = stretch.cwiseInverse();

  StretchDerivatives energy;
  energy.first = scale * (stretch - third * inverse);
  energy.second = scale * (2.0 / 3.0 * third * inverse * inverse.transpose() -
                           2.0 / 3.0 * (inverse * stretch.transpose() + stretch * inverse.transpose()));
  energy.second.diagonal().array() += scale * (1 + third * inverse.array().square());
  add_volume_change(law.bulk_modulus, pressure, stretch, energy);
  return largest_tangent(energy, stretch);
}

}  // namespace brainshift::solve
