// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>

#include "solve/material/deformation.hpp"
#include "solve/material/material.hpp"
#include "solve/material/own_elasticity.hpp"

namespace brainshift::solve {

/// An own law ready for the solver. Each call goes through a function, so a step takes several times as long as with a
/// law of the library. J must be positive.
struct OwnLaw {
  static constexpr double least_dilatation = -1;  ///< θ where J = 0

  double shear_modulus;  ///< µ, Pa
  double bulk_modulus;   ///< K, Pa

  /// material.own must be there.
  explicit OwnLaw(const Material& material);

  /// ∂W/∂F without the volumetric part, Pa.
  Eigen::Matrix3d isochoric_stress(const Deformation& d) const { return own_->stress(d); }
  /// W_iso, Pa.
  double isochoric_energy(const Deformation& d) const { return own_->energy(d); }
  /// θ = J − 1 and ∂θ/∂F.
  double dilatation(const Deformation& d) const { return d.jacobian - 1; }
  Eigen::Matrix3d dilatation_slope(const Deformation& d) const { return d.cofactor; }

 private:
  std::shared_ptr<const OwnElasticity> own_;
};

/// Largest eigenvalue of the tangent ∂²W/∂F∂F at F, Pa, by central differences of the stress, with the pressure p given
/// and U'' = K.
double largest_tangent(const OwnLaw& law, const Eigen::Matrix3d& gradient, double pressure);

}  // namespace brainshift::solve
