// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/neo_hookean.hpp"

#include "solve/material/principal.hpp"

namespace brainshift::solve {

double largest_tangent(const NeoHookean& law, const Eigen::Matrix3d& gradient, double pressure) {
  const Eigen::Vector3d stretch = principal_stretches(gradient);
  const double scale = law.shear_modulus / std::pow(stretch.prod(), 2.0 / 3.0);
  const double third = stretch.squaredNorm() / 3;
  const Eigen::Vector3d inverse = stretch.cwiseInverse();

  StretchDerivatives energy;
  energy.first = scale * (stretch - third * inverse);
  energy.second = scale * (2.0 / 3.0 * third * inverse * inverse.transpose() -
                           2.0 / 3.0 * (inverse * stretch.transpose() + stretch * inverse.transpose()));
  energy.second.diagonal().array() += scale * (1 + third * inverse.array().square());
  add_volume_change(law.bulk_modulus, pressure, stretch, energy);
  return largest_tangent(energy, stretch);
}

}  // namespace brainshift::solve
