// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <limits>

#include "solve/material/deformation.hpp"
#include "solve/material/material.hpp"
#include "solve/material/principal.hpp"

namespace brainshift::solve {

/// St Venant-Kirchhoff, W = µ dev E : dev E + K/2 (tr E)², E the Green-Lagrange strain. For large rotations but strains
/// of some percent: under compression it softens, and at a stretch of 0.58 it gives way.
struct SaintVenantKirchhoff {
  static constexpr double least_dilatation = -std::numeric_limits<double>::infinity();  ///< the law does not know J = 0

  double shear_modulus;  ///< µ, Pa
  double bulk_modulus;   ///< K, Pa

  explicit SaintVenantKirchhoff(const Material& m)
      : shear_modulus(solve::shear_modulus(m)), bulk_modulus(solve::bulk_modulus(m)) {}

  /// ∂W/∂F without the volumetric part, Pa: F (2µ dev E).
  BRAINSHIFT_ON_DEVICE Eigen::Matrix3d isochoric_stress(const Deformation& d) const {
    return 2 * shear_modulus * d.gradient * deviatoric(green_lagrange(d.gradient));
  }
  /// µ dev E : dev E, Pa.
  BRAINSHIFT_ON_DEVICE double isochoric_energy(const Deformation& d) const {
    return shear_modulus * deviatoric(green_lagrange(d.gradient)).squaredNorm();
  }
  /// θ = tr E and ∂θ/∂F.
  BRAINSHIFT_ON_DEVICE double dilatation(const Deformation& d) const { return green_lagrange(d.gradient).trace(); }
  BRAINSHIFT_ON_DEVICE Eigen::Matrix3d dilatation_slope(const Deformation& d) const { return d.gradient; }
};

/// Largest eigenvalue of the tangent ∂²W/∂F∂F at F, Pa, with the pressure p given, as a patch shares it, and U'' = K.
BRAINSHIFT_ON_DEVICE inline double largest_tangent(const SaintVenantKirchhoff& law, const Eigen::Matrix3d& gradient,
                                                   double pressure) {
  const Eigen::Vector3d stretch = principal_stretches(gradient);
  const Eigen::Vector3d square = stretch.cwiseAbs2();
  // derivatives by the strains E_i = (λ_i² − 1)/2, with ∂E_i/∂λ_i = λ_i
  const Eigen::Vector3d stress = law.shear_modulus * (square.array() - square.mean()) + pressure;
  StretchDerivatives energy;
  energy.first = stress.cwiseProduct(stretch);
  energy.second = (law.bulk_modulus - 2 * law.shear_modulus / 3) * stretch * stretch.transpose();
  energy.second.diagonal() += 2 * law.shear_modulus * square + stress;
  return largest_tangent(energy, stretch);
}

}  // namespace brainshift::solve
