// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/material.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "solve/material/own_elasticity.hpp"

namespace brainshift::solve {

double shear_modulus(const Material& material) {
  if (material.law == Law::own) {
    return material.own->shear_modulus;
  }
  if (material.law != Law::ogden) {
    return material.youngs_modulus / (2 * (1 + material.poisson_ratio));
  }
  double sum = 0;
  for (const OgdenTerm& term : material.ogden) {
    sum += term.shear_modulus;
  }
  return sum;
}

double bulk_modulus(const Material& material) {
  const double nu = material.poisson_ratio;
  return 2 * shear_modulus(material) * (1 + nu) / (3 * (1 - 2 * nu));
}

bool is_times(double times, double shear_modulus, double other) {
  constexpr double rounding = 1e-9;
  return shear_modulus >= (1 - rounding) * times * other;
}

bool much_stiffer(double shear_modulus, double other) {
  return is_times(10, shear_modulus, other);
}

double stiffness_contrast(const std::map<std::int32_t, Material>& materials) {
  double stiffest = 0, softest = std::numeric_limits<double>::infinity();
  for (const auto& [label, material] : materials) {
    stiffest = std::max(stiffest, shear_modulus(material));
    softest = std::min(softest, shear_modulus(material));
  }
  return materials.empty() ? 1 : stiffest / softest;
}

namespace {

OwnElasticity multiplied(double factor, const OwnElasticity& own) {
  return {.shear_modulus = factor * own.shear_modulus,
          .energy = [factor, of = own.energy](const Deformation& d) { return factor * of(d); },
          .stress = [factor, of = own.stress](const Deformation& d) { return Eigen::Matrix3d(factor * of(d)); }};
}

}  // namespace

Material stiffened(Material material, double factor) {
  material.youngs_modulus *= factor;
  for (OgdenTerm& term : material.ogden) {
    term.shear_modulus *= factor;
  }
  if (material.own) {
    material.own = std::make_shared<const OwnElasticity>(multiplied(factor, *material.own));
  }
  return material;
}

Material linearised(Material material) {
  material.youngs_modulus = 2 * shear_modulus(material) * (1 + material.poisson_ratio);
  material.law = Law::linear_elastic;
  material.ogden.clear();
  material.own.reset();
  return material;
}

Material long_term(Material material) {
  double left = 1;
  for (const PronyTerm& term : material.prony) {
    left -= term.share;
  }
  const double bulk = bulk_modulus(material);
  const double shear = left * shear_modulus(material);
  material = stiffened(std::move(material), left);
  material.youngs_modulus = 9 * bulk * shear / (3 * bulk + shear);
  material.poisson_ratio = (3 * bulk - 2 * shear) / (6 * bulk + 2 * shear);
  material.prony.clear();
  return material;
}

}  // namespace brainshift::solve
