// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/force/internal_force.hpp"

namespace brainshift::solve {

/// The strain of an integration point of a plane problem as a tear meets it.
struct PointStrain {
  Eigen::Matrix2d right_cauchy_green;  ///< C = FᵀF in the plane, of the elastic part of F where tissue swells
  double largest_stretch;              ///< principal, in the plane
  double largest_stress;               ///< principal Cauchy stress in the plane, Pa, of the elastic law
};

/// Of all points, in the order of the blocks, at the last internal_force().
std::vector<PointStrain> point_strains(const PointBlocks& points, const PointLaws& laws, const ForceScratch& scratch);

}  // namespace brainshift::solve
