// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "segmentation/geometry/points.hpp"
#include "segmentation/geometry/surface.hpp"
#include "solve/interface/model.hpp"

namespace brainshift::solve {

/// Forces at places, (n × 3).
struct PlacedForces {
  Points places;  ///< undeformed, mm
  Points force;   ///< N
};

/// Whether there is a wall, and a pressure on it.
bool presses_on_wall(const Resection& resection);

/// Pressure in the cavity of a resection, Pa, at an undeformed place (mm): the given one, and where the cavity's fluid
/// has a level of its own, L_c against L of the fluid about the brain,
///   p = ρ_f |g| (max(0, X·d − L_c) − max(0, X·d − L)).
/// The fluid about the brain needs no term of its own: its pressure on the wall is part of the force on the tissue
/// (add_fluid_force()). model: with a resection, and with a fluid where the resection has a level.
std::function<double(const Eigen::Vector3d&)> cavity_pressure(const Model& model);

/// p n dA on a surface with normals out of the cavity, summed over pieces of its triangles with edges of at most
/// `longest` mm: ∫ p n dA exactly where p is linear. pressure: Pa at a place.
PlacedForces forces_on_wall(const Surface& wall, double longest,
                            const std::function<double(const Eigen::Vector3d&)>& pressure);

}  // namespace brainshift::solve
