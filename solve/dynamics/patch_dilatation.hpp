// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "solve/dynamics/internal_force.hpp"

namespace brainshift::solve {

inline Eigen::Map<const Eigen::Matrix3d> gradient_of(const ForceScratch& scratch, std::int32_t point) {
  return Eigen::Map<const Eigen::Matrix3d>(scratch.gradient.data() + 9 * static_cast<std::size_t>(point));
}

/// Stiffness against the part of the dilatation that a patch's pressure modes do not see, Pa: as soft as the shear, so
/// that it does not lock, yet keeps single points from turning inside out.
template <class ElasticLaw>
double unprojected_modulus(const ElasticLaw& law) {
  return std::min(law.bulk_modulus, law.shear_modulus);
}

/// Σ_I w ψ_k θ: the dilatation of a patch on its pressure modes, from the gradients in scratch.
template <class ElasticLaw>
Eigen::Vector4d projected_dilatation(const PointBlocks& points, const Patch& patch, const ElasticLaw& law,
                                     const ForceScratch& scratch) {
  Eigen::Vector4d coefficients = Eigen::Vector4d::Zero();
  for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
    const double dilatation = law.dilatation(Deformation(gradient_of(scratch, p)));
    coefficients += points.volume[static_cast<std::size_t>(p)] * dilatation * points.modes_of(p);
  }
  return coefficients;
}

}  // namespace brainshift::solve
