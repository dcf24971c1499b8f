// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/own_law.hpp"

#include <Eigen/Eigenvalues>

namespace brainshift::solve {

namespace {

using Tangent = Eigen::Matrix<double, 9, 9>;

}  // namespace

OwnLaw::OwnLaw(const Material& material)
    : shear_modulus(solve::shear_modulus(material)), bulk_modulus(solve::bulk_modulus(material)), own_(material.own) {}

double largest_tangent(const OwnLaw& law, const Eigen::Matrix3d& gradient, double pressure) {
  constexpr double step = 1e-6;  // of F, without unit: the differences keep half of the digits
  const auto stress = [&](const Eigen::Matrix3d& f) {
    const Deformation d(f);
    return Eigen::Matrix3d(law.isochoric_stress(d) + pressure * d.cofactor);
  };
  Tangent tangent;
  for (int k = 0; k < 9; ++k) {
    Eigen::Matrix3d ahead = gradient, behind = gradient;
    ahead.data()[k] += step;
    behind.data()[k] -= step;
    tangent.col(k) = (stress(ahead) - stress(behind)).reshaped() / (2 * step);
  }
  const Eigen::Matrix<double, 9, 1> slope = Deformation(gradient).cofactor.reshaped();
  tangent += law.bulk_modulus * slope * slope.transpose();
  const Tangent symmetric = (tangent + tangent.transpose()) / 2;
  return Eigen::SelfAdjointEigenSolver<Tangent>(symmetric, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

}  // namespace brainshift::solve
