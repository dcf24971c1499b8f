// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/principal.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "solve/material/deformation.hpp"

namespace brainshift::solve {

namespace {

/// In closed form: off by 1e-8 where they meet, which is enough for a bound, at half the time of the exact ones.
Eigen::Vector3d eigenvalues(const Eigen::Matrix3d& symmetric) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(symmetric, Eigen::EigenvaluesOnly);
  return solver.eigenvalues();
}

}  // namespace

Eigen::Vector3d principal_stretches(const Eigen::Matrix3d& gradient) {
  const Eigen::Vector3d strain = eigenvalues(green_lagrange(gradient));
  return (1 + 2 * strain.array()).max(1e-8).sqrt();
}

void add_volume_change(double bulk_modulus, double pressure, const Eigen::Vector3d& stretch,
                       StretchDerivatives& energy) {
  const double jacobian = stretch.prod();
  const Eigen::Vector3d slope = jacobian * stretch.cwiseInverse();
  energy.first += pressure * slope;
  energy.second += (bulk_modulus + pressure / jacobian) * slope * slope.transpose();
  energy.second.diagonal() -= pressure / jacobian * slope.cwiseAbs2();
}

double largest_tangent(const StretchDerivatives& energy, const Eigen::Vector3d& stretch) {
  double largest = eigenvalues(energy.second).maxCoeff();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const double sum = stretch[i] + stretch[j];
    const double difference = stretch[i] - stretch[j];
    // as W is even in the difference, the mean of the two limits is right to its second order
    const double shear = std::abs(difference) > 1e-5 * sum
                             ? (energy.first[i] - energy.first[j]) / difference
                             : (energy.second(i, i) + energy.second(j, j)) / 2 - energy.second(i, j);
    largest = std::max({largest, shear, (energy.first[i] + energy.first[j]) / sum});
  }
  return largest;
}

}  // namespace brainshift::solve
