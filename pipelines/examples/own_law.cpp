// SPDX-License-Identifier: GPL-3.0-or-later
//
// A material law of one's own: Fung's exponential one, W = µ/(2b) (exp(b (Ī1 − 3)) − 1) + K/2 (J − 1)², on a cube that
// is pressed by a tenth. Prints the reaction beside the neo-Hookean one, which the law becomes as b goes to 0.
#include <cmath>
#include <iostream>

#include "block.hpp"
#include "solve/material/own_elasticity.hpp"
#include "solve/solve.hpp"

namespace {

using namespace brainshift;

/// Needs µ (Pa) and b, answers energy and stress of the isochoric part.
solve::OwnElasticity fung(double shear_modulus, double b) {
  // Ī1 − 3 and its derivative by F
  const auto strain = [](const solve::Deformation& d) {
    return std::pow(d.jacobian, -2.0 / 3.0) * d.gradient.squaredNorm() - 3;
  };
  const auto slope = [](const solve::Deformation& d) {
    return Eigen::Matrix3d(2 * std::pow(d.jacobian, -2.0 / 3.0) *
                           (d.gradient - d.gradient.squaredNorm() / (3 * d.jacobian) * d.cofactor));
  };
  return {.shear_modulus = shear_modulus,
          .energy = [=](const solve::Deformation& d) { return shear_modulus / (2 * b) * std::expm1(b * strain(d)); },
          .stress =
              [=](const solve::Deformation& d) {
                return Eigen::Matrix3d(shear_modulus / 2 * std::exp(b * strain(d)) * slope(d));
              }};
}

double reaction(const solve::Material& material) {
  solve::Model model = examples::pressed_cube();
  model.materials = {{1, material}};
  const solve::SolveResult result = solve::solve(model, {});
  return result.measures.converged ? result.history.back().reaction.z() : std::nan("");
}

}  // namespace

int main() {
  const double neo_hookean = reaction({.poisson_ratio = 0.45});
  const double mu = solve::shear_modulus({.poisson_ratio = 0.45});
  std::cout << "neo-Hookean: " << neo_hookean << " N\n";
  double hardest = 0;
  for (const double b : {1e-6, 10.0}) {
    solve::Material material{.poisson_ratio = 0.45, .law = solve::Law::own};
    material.own = std::make_shared<const solve::OwnElasticity>(fung(mu, b));
    hardest = reaction(material);
    std::cout << "Fung, b = " << b << ": " << hardest << " N\n";
  }
  return hardest < neo_hookean ? 0 : 1;  // both negative: the stiffer one pushes back more
}
