// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>

#include "solve/material/deformation.hpp"

namespace brainshift::solve {

/// The isochoric part of an elastic law that a program brings along (Material::own), W = W_iso(F) + K/2 (J − 1)².
struct OwnElasticity {
  double shear_modulus = 0;                                   ///< µ at rest, Pa
  std::function<double(const Deformation&)> energy;           ///< W_iso, Pa; 0 at rest, the same in every frame
  std::function<Eigen::Matrix3d(const Deformation&)> stress;  ///< ∂W_iso/∂F, Pa
};

}  // namespace brainshift::solve
