// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/ogden.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "solve/material/principal.hpp"
#include "solve/material/symmetric_eigen.hpp"

namespace brainshift::solve {

namespace {

/// ln λ̄_i, the mean of ln λ_i taken off, from principal Green-Lagrange strains.
Eigen::Vector3d isochoric_logarithms(const Eigen::Vector3d& strain) {
  const Eigen::Vector3d logarithm = strain.unaryExpr([](double e) { return std::log1p(2 * e) / 2; });
  return logarithm.array() - logarithm.mean();
}

/// λ̄_i^α − 1.
Eigen::Vector3d powers_less_one(const Eigen::Vector3d& logarithm, double exponent) {
  return logarithm.unaryExpr([exponent](double l) { return std::expm1(exponent * l); });
}

/// e^x − 1 − x without the cancellation of small x.
double exp_beyond_linear(double x) {
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

}  // namespace

Ogden::Ogden(const Material& material)
    : shear_modulus(solve::shear_modulus(material)),
      bulk_modulus(solve::bulk_modulus(material)),
      count_(material.ogden.size()) {
  if (count_ == 0 || count_ > capacity) {
    throw std::invalid_argument("Ogden's law takes 1 to " + std::to_string(capacity) + " terms, not " +
                                std::to_string(count_));
  }
  std::copy(material.ogden.begin(), material.ogden.end(), terms_.begin());
}

Eigen::Matrix3d Ogden::isochoric_stress(const Deformation& d) const {
  const SymmetricEigen strain = symmetric_eigen(green_lagrange(d.gradient));
  const Eigen::Vector3d logarithm = isochoric_logarithms(strain.values);
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();  // λ_i ∂W/∂λ_i
  for (const OgdenTerm& term : terms()) {
    const Eigen::Vector3d power = powers_less_one(logarithm, term.exponent);
    slope.array() += 2 * term.shear_modulus / term.exponent * (power.array() - power.mean());
  }
  const Eigen::Vector3d second_stress = slope.array() / (1 + 2 * strain.values.array());
  return d.gradient * strain.vectors * second_stress.asDiagonal() * strain.vectors.transpose();
}

double Ogden::isochoric_energy(const Deformation& d) const {
  const Eigen::Vector3d logarithm = isochoric_logarithms(symmetric_eigen(green_lagrange(d.gradient)).values);
  double energy = 0;
  for (const OgdenTerm& term : terms()) {
    double sum = 0;
    for (const double l : logarithm) {
      sum += exp_beyond_linear(term.exponent * l);  // the linear parts cancel, as Σ ln λ̄_i = 0
    }
    energy += 2 * term.shear_modulus / (term.exponent * term.exponent) * sum;
  }
  return energy;
}

double largest_tangent(const Ogden& law, const Eigen::Matrix3d& gradient, double pressure) {
  const Eigen::Vector3d stretch = principal_stretches(gradient);
  const Eigen::Vector3d inverse = stretch.cwiseInverse();
  const Eigen::Vector3d logarithm = stretch.array().log() - stretch.array().log().mean();

  StretchDerivatives energy{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
  for (const OgdenTerm& term : law.terms()) {
    const Eigen::Vector3d power = powers_less_one(logarithm, term.exponent).array() + 1;
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
