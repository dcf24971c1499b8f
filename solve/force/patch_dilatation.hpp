// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "solve/force/point_blocks.hpp"
#include "solve/force/point_pressure.hpp"
#include "solve/material/deformation.hpp"

namespace brainshift::solve {

/// Σ_I w ψ_k θ: the dilatation of a patch on its pressure modes, from the gradients at its points.
template <class ElasticLaw>
Eigen::Vector4d projected_dilatation(const PointBlocks& points, const Patch& patch, const ElasticLaw& law,
                                     std::span<const Eigen::Matrix3d> gradients) {
  Eigen::Vector4d coefficients = Eigen::Vector4d::Zero();
  for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
    const double dilatation = law.dilatation(Deformation(gradients[static_cast<std::size_t>(p - patch.first_point)]));
    coefficients += points.volume[static_cast<std::size_t>(p)] * dilatation * points.modes_of(p);
  }
  return coefficients;
}

}  // namespace brainshift::solve
