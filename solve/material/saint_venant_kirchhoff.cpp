// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/saint_venant_kirchhoff.hpp"

#include "solve/material/principal.hpp"

namespace brainshift::solve {

double largest_tangent(const SaintVenantKirchhoff& law, const Eigen::Matrix3d& gradient, double pressure) {
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
