// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>

#include "solve/material/deformation.hpp"
#include "solve/material/material.hpp"

namespace brainshift::solve {

/// Linear elasticity, W = µ dev ε : dev ε + K/2 (tr ε)², ε = sym F − 1. Takes a rotation for a strain, of the order of
/// the angle's square: for small rotations too.
struct LinearElastic {
  static constexpr double least_dilatation = -std::numeric_limits<double>::infinity();  ///< the law does not know J = 0

  double shear_modulus;  ///< µ, Pa
  double bulk_modulus;   ///< K, Pa

  explicit LinearElastic(const Material& m)
      : shear_modulus(solve::shear_modulus(m)), bulk_modulus(solve::bulk_modulus(m)) {}

  /// ∂W/∂F without the volumetric part, Pa: 2µ dev ε.
  BRAINSHIFT_ON_DEVICE Eigen::Matrix3d isochoric_stress(const Deformation& d) const {
    return 2 * shear_modulus * deviatoric(small_strain(d.gradient));
  }
  /// µ dev ε : dev ε, Pa.
  BRAINSHIFT_ON_DEVICE double isochoric_energy(const Deformation& d) const {
    return shear_modulus * deviatoric(small_strain(d.gradient)).squaredNorm();
  }
  /// θ = tr ε and ∂θ/∂F.
  BRAINSHIFT_ON_DEVICE double dilatation(const Deformation& d) const { return d.gradient.trace() - 3; }
  BRAINSHIFT_ON_DEVICE Eigen::Matrix3d dilatation_slope(const Deformation&) const {
    return Eigen::Matrix3d::Identity();
  }
};

/// Largest eigenvalue of the tangent ∂²W/∂F∂F, Pa, the same everywhere: 3K of a change of volume or 2µ of one of shape.
BRAINSHIFT_ON_DEVICE inline double largest_tangent(const LinearElastic& law, const Eigen::Matrix3d&, double) {
  return std::max(3 * law.bulk_modulus, 2 * law.shear_modulus);
}

}  // namespace brainshift::solve
