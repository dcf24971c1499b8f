// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/neo_hookean.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace brainshift::solve {

double largest_tangent(const NeoHookean& law, const Eigen::Vector3d& stretch, double pressure) {
  const double jacobian = stretch.prod();
  const double scale = law.shear_modulus * std::pow(jacobian, -2.0 / 3.0);
  const double i1 = stretch.squaredNorm();
  Eigen::Matrix3d stretching;
  double shearing = 0;
  for (int i = 0; i < 3; ++i) {
    const double isochoric_slope = stretch[i] - i1 / (3 * stretch[i]);
    for (int j = 0; j < 3; ++j) {
      const double product = stretch[i] * stretch[j];
      const double isochoric = -2 * isochoric_slope / (3 * stretch[j]) - 2 * stretch[j] / (3 * stretch[i]) +
                               (i == j ? 1 + i1 / (3 * stretch[i] * stretch[i]) : 0.0);
      const double volumetric = law.bulk_modulus * jacobian * jacobian + (i == j ? 0.0 : pressure * jacobian);
      stretching(i, j) = scale * isochoric + volumetric / product;
      if (i < j) {
        const double slope_i = scale * isochoric_slope + pressure * jacobian / stretch[i];
        const double slope_j = scale * (stretch[j] - i1 / (3 * stretch[j])) + pressure * jacobian / stretch[j];
        const double difference = scale * (1 + i1 / (3 * product)) - pressure * jacobian / product;
        shearing = std::max({shearing, difference, (slope_i + slope_j) / (stretch[i] + stretch[j])});
      }
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(stretching, Eigen::EigenvaluesOnly);
  return std::max(shearing, eigen.eigenvalues().maxCoeff());
}

}  // namespace brainshift::solve
