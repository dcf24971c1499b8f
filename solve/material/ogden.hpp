// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "solve/material/deformation.hpp"
#include "solve/material/material.hpp"

namespace brainshift::solve {

/// Ogden, W = Σ_k 2µ_k/α_k² (λ̄1^α_k + λ̄2^α_k + λ̄3^α_k − 3) + K/2 (J − 1)², λ̄_i = J^(−1/3) λ_i: ABAQUS's and CalculiX's
/// OGDEN with D1 = 2/K. One term with α = 2 is neo-Hookean. J must be positive.
struct Ogden {
  static constexpr std::size_t capacity = 6;
  static constexpr double least_dilatation = -1;  ///< θ where J = 0

  double shear_modulus;  ///< Σ µ_k, Pa
  double bulk_modulus;   ///< K, Pa

  /// Throws std::invalid_argument unless the material has 1 to `capacity` Ogden terms.
  explicit Ogden(const Material& material);

  std::span<const OgdenTerm> terms() const { return std::span(terms_).first(count_); }

  /// ∂W/∂F without the volumetric part, Pa.
  Eigen::Matrix3d isochoric_stress(const Deformation& d) const;
  /// The sum over the terms, Pa; strains of 1e-8 still give digits.
  double isochoric_energy(const Deformation& d) const;
  /// θ = J − 1 and ∂θ/∂F.
  double dilatation(const Deformation& d) const { return d.jacobian - 1; }
  Eigen::Matrix3d dilatation_slope(const Deformation& d) const { return d.cofactor; }

 private:
  std::array<OgdenTerm, capacity> terms_{};
  std::size_t count_;
};

/// Largest eigenvalue of the tangent ∂²W/∂F∂F at F, Pa, with the pressure p given, as a patch shares it, and U'' = K.
double largest_tangent(const Ogden& law, const Eigen::Matrix3d& gradient, double pressure);

}  // namespace brainshift::solve
