// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <memory>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "solve/material/elastic_law.hpp"

namespace brainshift::solve {

/// A law that the library does not have: Fung's, W_iso = µ/(2b) (exp(b (Ī1 − 3)) − 1).
inline Material fung(double shear_modulus, double b, double poisson_ratio) {
  const auto strain = [](const Deformation& d) {
    return std::pow(d.jacobian, -2.0 / 3.0) * d.gradient.squaredNorm() - 3;
  };
  const auto energy = [=](const Deformation& d) { return shear_modulus / (2 * b) * std::expm1(b * strain(d)); };
  const auto stress = [=](const Deformation& d) {
    const double scale = shear_modulus * std::exp(b * strain(d)) * std::pow(d.jacobian, -2.0 / 3.0);
    return Eigen::Matrix3d(scale * (d.gradient - d.gradient.squaredNorm() / (3 * d.jacobian) * d.cofactor));
  };
  const OwnElasticity own{.shear_modulus = shear_modulus, .energy = energy, .stress = stress};
  return {.poisson_ratio = poisson_ratio, .law = Law::own, .own = std::make_shared<const OwnElasticity>(own)};
}

/// Laws for large deformations, soft and hard to compress, of one and of several terms.
inline const std::vector<Material> finite_strain_laws = {
    {.poisson_ratio = 0.49},
    {.youngs_modulus = 10, .poisson_ratio = 0.1},
    {.law = Law::ogden, .ogden = {{842, -4.7}}},
    {.poisson_ratio = 0.3, .law = Law::ogden, .ogden = {{900, 1.3}, {-50, 5}, {100, -2}}},
    {.poisson_ratio = 0.49, .law = Law::saint_venant_kirchhoff},
    {.poisson_ratio = -0.2, .law = Law::saint_venant_kirchhoff},
    fung(1000, 0.5, 0.49),
};

inline const std::vector<Material> every_law = [] {
  std::vector<Material> laws = finite_strain_laws;
  laws.push_back({.poisson_ratio = 0.49, .law = Law::linear_elastic});
  laws.push_back({.poisson_ratio = -0.4, .law = Law::linear_elastic});
  return laws;
}();

/// Those that devices know.
inline const std::vector<Material> library_laws = [] {
  std::vector<Material> laws = every_law;
  std::erase_if(laws, [](const Material& material) { return material.law == Law::own; });
  return laws;
}();

inline std::string name_of(const Material& material) {
  const std::string names[] = {"neo_hookean", "ogden", "saint_venant_kirchhoff", "linear_elastic", "own"};
  const std::string name = names[static_cast<int>(material.law)];
  return name + (material.poisson_ratio == 0.49 ? "_nearly_incompressible" : "_compressible");
}

/// What GoogleTest calls it.
inline void PrintTo(const Material& material, std::ostream* out) {
  *out << name_of(material);
}

inline Eigen::Matrix3d isochoric_stress(const ElasticLaw& law, const Eigen::Matrix3d& f) {
  return std::visit([&](const auto& l) { return l.isochoric_stress(Deformation(f)); }, law);
}

inline double dilatation(const ElasticLaw& law, const Eigen::Matrix3d& f) {
  return std::visit([&](const auto& l) { return l.dilatation(Deformation(f)); }, law);
}

inline Eigen::Matrix3d dilatation_slope(const ElasticLaw& law, const Eigen::Matrix3d& f) {
  return std::visit([&](const auto& l) { return l.dilatation_slope(Deformation(f)); }, law);
}

inline double pressure(const ElasticLaw& law, const Eigen::Matrix3d& f) {
  return std::visit([&](const auto& l) { return l.bulk_modulus * l.dilatation(Deformation(f)); }, law);
}

inline double energy(const ElasticLaw& law, const Eigen::Matrix3d& f) {
  const Deformation d(f);
  return std::visit(
      [&](const auto& l) { return l.isochoric_energy(d) + l.bulk_modulus / 2 * std::pow(l.dilatation(d), 2); }, law);
}

/// First Piola–Kirchhoff, Pa.
inline Eigen::Matrix3d stress(const ElasticLaw& law, const Eigen::Matrix3d& f) {
  return isochoric_stress(law, f) + pressure(law, f) * dilatation_slope(law, f);
}

inline Eigen::Matrix3d random_deformation(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> within(-0.3, 0.3);
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  for (double& entry : f.reshaped()) {
    entry += within(random);
  }
  return f;
}

}  // namespace brainshift::solve
