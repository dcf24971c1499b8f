// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "segmentation/geometry/on_device.hpp"

namespace brainshift::solve {

/// What the laws need of the deformation gradient at a point; all without units.
struct Deformation {
  Eigen::Matrix3d gradient;  ///< F
  Eigen::Matrix3d cofactor;  ///< J F⁻ᵀ = ∂J/∂F
  double jacobian;           ///< J = det F

  BRAINSHIFT_ON_DEVICE explicit Deformation(const Eigen::Matrix3d& f) : gradient(f) {
    cofactor.col(0) = f.col(1).cross(f.col(2));
    cofactor.col(1) = f.col(2).cross(f.col(0));
    cofactor.col(2) = f.col(0).cross(f.col(1));
    jacobian = f.col(0).dot(cofactor.col(0));
  }
};

/// J^(−2/3).
BRAINSHIFT_ON_DEVICE inline double to_minus_two_thirds(double jacobian) {
#ifdef __CUDA_ARCH__
  const double root = rcbrt(jacobian);  // a fraction of what a power takes there
  return root * root;
#else
  return std::pow(jacobian, -2.0 / 3.0);
#endif
}

/// Green-Lagrange strain E = (FᵀF − 1)/2, from the displacement gradient so that small strains keep their digits.
BRAINSHIFT_ON_DEVICE inline Eigen::Matrix3d green_lagrange(const Eigen::Matrix3d& gradient) {
  const Eigen::Matrix3d h = gradient - Eigen::Matrix3d::Identity();
  return 0.5 * (h + h.transpose() + h.transpose() * h);
}

/// Small strain ε = (F + Fᵀ)/2 − 1.
BRAINSHIFT_ON_DEVICE inline Eigen::Matrix3d small_strain(const Eigen::Matrix3d& gradient) {
  return 0.5 * (gradient + gradient.transpose()) - Eigen::Matrix3d::Identity();
}

/// A symmetric tensor without its mean.
BRAINSHIFT_ON_DEVICE inline Eigen::Matrix3d deviatoric(const Eigen::Matrix3d& tensor) {
  return tensor - tensor.trace() / 3 * Eigen::Matrix3d::Identity();
}

}  // namespace brainshift::solve
