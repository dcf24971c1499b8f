// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/elastic_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/unit/solve/material_cases.hpp"

// Homogeneous deformations of an incompressible body, whose nominal stress is known in closed form.

namespace brainshift::solve::elastic_law_homogeneous_test {

constexpr double mu = 842;
constexpr double poisson_ratio = 0.4999999;
constexpr double alpha = -4.7;

const Material neo_hookean{.youngs_modulus = 2 * mu * (1 + poisson_ratio), .poisson_ratio = poisson_ratio};
const Material ogden{.poisson_ratio = poisson_ratio, .law = Law::ogden, .ogden = {{mu, alpha}}};

/// The nominal stress along the first axis where axis `free` carries none: its stretch, next to `guess`, by bisection.
double nominal_stress(const ElasticLaw& law, const std::function<Eigen::Vector3d(double)>& stretches, int free,
                      double guess) {
  const auto at = [&](double stretch) { return stress(law, stretches(stretch).asDiagonal().toDenseMatrix()); };
  double low = 0.9 * guess, high = 1.1 * guess;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (at(middle)(free, free) > 0 ? high : low) = middle;
  }
  return at((low + high) / 2)(0, 0);
}

double uniaxial(const Material& material, double stretch) {
  const auto stretches = [=](double side) { return Eigen::Vector3d(stretch, side, side); };
  return nominal_stress(elastic_law(material), stretches, 1, 1 / std::sqrt(stretch));
}

double equibiaxial(const Material& material, double stretch) {
  const auto stretches = [=](double height) { return Eigen::Vector3d(stretch, stretch, height); };
  return nominal_stress(elastic_law(material), stretches, 2, 1 / (stretch * stretch));
}

double simple_shear(const Material& material, double amount) {
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  f(0, 1) = amount;
  return stress(elastic_law(material), f)(0, 1);
}

void expect_close(double actual, double expected, double at) {
  EXPECT_NEAR(actual, expected, 1e-5 * (mu + std::abs(expected))) << at;
}

TEST(NearlyIncompressible, UniaxialStress) {
  for (const double l : {0.4, 0.8, 0.99, 1.0, 1.05, 1.5, 2.5}) {
    expect_close(uniaxial(neo_hookean, l), mu * (l - std::pow(l, -2)), l);
    expect_close(uniaxial(ogden, l), 2 * mu / alpha * (std::pow(l, alpha - 1) - std::pow(l, -alpha / 2 - 1)), l);
  }
}

TEST(NearlyIncompressible, EquibiaxialStress) {
  for (const double l : {0.7, 0.9, 1.0, 1.1, 1.4}) {
    expect_close(equibiaxial(neo_hookean, l), mu * (l - std::pow(l, -5)), l);
    expect_close(equibiaxial(ogden, l), 2 * mu / alpha * (std::pow(l, alpha - 1) - std::pow(l, -2 * alpha - 1)), l);
  }
}

TEST(NearlyIncompressible, SimpleShear) {
  for (const double amount : {-0.5, 0.01, 0.2, 1.0}) {
    const double l = amount / 2 + std::sqrt(1 + amount * amount / 4);
    expect_close(simple_shear(neo_hookean, amount), mu * amount, amount);
    expect_close(simple_shear(ogden, amount), 2 * mu / alpha * (std::pow(l, alpha) - std::pow(l, -alpha)) / (l + 1 / l),
                 amount);
  }
}

}  // namespace brainshift::solve::elastic_law_homogeneous_test
