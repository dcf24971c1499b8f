// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "solve/material/deformation.hpp"
#include "solve/material/material.hpp"
#include "solve/material/principal.hpp"
#include "solve/material/symmetric_eigen.hpp"

namespace brainshift::solve {

namespace of_ogden {

/// ln λ̄_i, the mean of ln λ_i taken off, from principal Green-Lagrange strains.
BRAINSHIFT_ON_DEVICE inline Eigen::Vector3d isochoric_logarithms(const Eigen::Vector3d& strain) {
  const Eigen::Vector3d logarithm = strain.unaryExpr([](double e) { return std::log1p(2 * e) / 2; });
  return logarithm.array() - logarithm.mean();
}

/// λ̄_i^α − 1.
BRAINSHIFT_ON_DEVICE inline Eigen::Vector3d powers_less_one(const Eigen::Vector3d& logarithm, double exponent) {
  return logarithm.unaryExpr([exponent](double l) { return std::expm1(exponent * l); });
}

/// e^x − 1 − x without the cancellation of small x.
BRAINSHIFT_ON_DEVICE inline double exp_beyond_linear(double x) {
  if (std::abs(x) > 0.3) {
    return std::expm1(x) - x;
  }
  double term = x * x / 2;
  double sum = term;
  for (int n = 3; n < 15; ++n) {
    term *= x / n;
    sum += term;
  }
  return sum;
}

}  // namespace of_ogden

/// Ogden, W = Σ_k 2µ_k/α_k² (λ̄1^α_k + λ̄2^α_k + λ̄3^α_k − 3) + K/2 (J − 1)², λ̄_i = J^(−1/3) λ_i: ABAQUS's and CalculiX's
/// OGDEN with D1 = 2/K. One term with α = 2 is neo-Hookean. J must be positive.
struct Ogden {
  static constexpr std::size_t capacity = 6;
  static constexpr double least_dilatation = -1;  ///< θ where J = 0

  double shear_modulus;  ///< Σ µ_k, Pa
  double bulk_modulus;   ///< K, Pa

  /// Throws std::invalid_argument unless the material has 1 to `capacity` Ogden terms.
  explicit Ogden(const Material& material);

  BRAINSHIFT_ON_DEVICE std::span<const OgdenTerm> terms() const { return std::span(terms_).first(count_); }

  /// ∂W/∂F without the volumetric part, Pa.
  BRAINSHIFT_ON_DEVICE Eigen::Matrix3d isochoric_stress(const Deformation& d) const;
  /// The sum over the terms, Pa; strains of 1e-8 still give digits.
  BRAINSHIFT_ON_DEVICE double isochoric_energy(const Deformation& d) const;
  /// θ = J − 1 and ∂θ/∂F.
  BRAINSHIFT_ON_DEVICE double dilatation(const Deformation& d) const { return d.jacobian - 1; }
  BRAINSHIFT_ON_DEVICE Eigen::Matrix3d dilatation_slope(const Deformation& d) const { return d.cofactor; }

 private:
  std::array<OgdenTerm, capacity> terms_{};
  std::size_t count_;
};

BRAINSHIFT_ON_DEVICE inline Eigen::Matrix3d Ogden::isochoric_stress(const Deformation& d) const {
  const SymmetricEigen strain = symmetric_eigen(green_lagrange(d.gradient));
  const Eigen::Vector3d logarithm = of_ogden::isochoric_logarithms(strain.values);
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();  // λ_i ∂W/∂λ_i
  for (const OgdenTerm& term : terms()) {
    const Eigen::Vector3d power = of_ogden::powers_less_one(logarithm, term.exponent);
    slope.array() += 2 * term.shear_modulus / term.exponent * (power.array() - power.mean());
  }
  const Eigen::Vector3d second_stress = slope.array() / (1 + 2 * strain.values.array());
  return d.gradient * strain.vectors * second_stress.asDiagonal() * strain.vectors.transpose();
}

BRAINSHIFT_ON_DEVICE inline double Ogden::isochoric_energy(const Deformation& d) const {
  const Eigen::Vector3d logarithm = of_ogden::isochoric_logarithms(symmetric_eigen(green_lagrange(d.gradient)).values);
  double energy = 0;
  for (const OgdenTerm& term : terms()) {
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
      sum += of_ogden::exp_beyond_linear(term.exponent * logarithm[i]);  // the linear parts cancel, as Σ ln λ̄_i = 0
    }
    energy += 2 * term.shear_modulus / (term.exponent * term.exponent) * sum;
  }
  return energy;
}

/// Largest eigenvalue of the tangent ∂²W/∂F∂F at F, Pa, with the pressure p given, as a patch shares it, and U'' = K.
BRAINSHIFT_ON_DEVICE inline double largest_tangent(const Ogden& law, const Eigen::Matrix3d& gradient, double pressure) {
  const Eigen::Vector3d stretch = principal_stretches(gradient);
  const Eigen::Vector3d inverse = stretch.cwiseInverse();
  const Eigen::Vector3d logarithm = stretch.array().log() - stretch.array().log().mean();

  StretchDerivatives energy{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
  for (const OgdenTerm& term : law.terms()) {
    const Eigen::Vector3d power = of_ogden::powers_less_one(logarithm, term.exponent).array() + 1;
    const double mean = power.mean();
    const Eigen::Vector3d slope = 2 * term.shear_modulus / term.exponent * (power.array() - mean) * inverse.array();
    energy.first += slope;
    energy.second.diagonal() -= slope.cwiseProduct(inverse);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const double own = i == j ? power[i] : 0;
        energy.second(i, j) +=
            2 * term.shear_modulus * inverse[i] * inverse[j] * (own - (power[i] + power[j] - mean) / 3);
      }
    }
  }
  add_volume_change(law.bulk_modulus, pressure, stretch, energy);
  return largest_tangent(energy, stretch);
}

}  // namespace brainshift::solve
