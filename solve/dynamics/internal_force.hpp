// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "solve/dynamics/point_blocks.hpp"
#include "solve/material/neo_hookean.hpp"

namespace brainshift::solve {

/// Vectors at nodes, four doubles each (x, y, z, unused), so that a node is one load of a vector register.
using NodalVectors = std::vector<double>;

/// Scratch of internal_force(): made once, reused in every step.
struct ForceScratch {
  std::vector<double> slot_displacement;  ///< 4 a slot
  std::vector<double> slot_force;         ///< 4 a slot
  std::vector<double> gradient;           ///< 9 a point: F, kept between the two passes over a patch

  explicit ForceScratch(const PointBlocks& points)
      : slot_displacement(4 * points.slots()), slot_force(4 * points.slots()), gradient(9 * points.points()) {}
};

/// f_int,a = Σ_I w P B_a (µN) at parameters û (mm); P the first Piola–Kirchhoff stress, its volumetric part by the mean
/// dilatation of the point's patch, J̄ = Σ wJ / Σ w, p = U'(J̄), which is the variation of Σ_patch V U(J̄). All threads;
/// the result does not depend on their number.
void internal_force(const PointBlocks& points, std::span<const NeoHookean> laws, const NodalVectors& parameters,
                    ForceScratch& scratch, NodalVectors& force);

/// State of the points at the parameters of the last internal_force().
struct PointState {
  double strain_energy = 0;  ///< 1e-9 J
  double smallest_jacobian = 1;
  double largest_stretch = 1;
};
PointState point_state(const PointBlocks& points, std::span<const NeoHookean> laws, const ForceScratch& scratch);

/// Largest tangent modulus ∂²W/∂F∂F (Pa) at each point at the last internal_force(), never less than at rest.
std::vector<double> tangent_moduli(const PointBlocks& points, std::span<const NeoHookean> laws,
                                   const ForceScratch& scratch);

}  // namespace brainshift::solve
