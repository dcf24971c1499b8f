// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solve/arrays/nodal_vectors.hpp"
#include "solve/force/force_scratch.hpp"

namespace brainshift::solve {

/// The elastic F_e at each point of a patch, at the parameters of the last internal_force(): where a tissue swells F is
/// F_e times ForceScratch::growth_of() its row, else F_e.
std::vector<Eigen::Matrix3d> gradients_of(const PointBlocks& points, const Patch& patch, const ForceScratch& scratch);

/// f_int,a = Σ_I w P B_a (µN) at parameters û (mm); P the first Piola–Kirchhoff stress. Its volumetric part is K θ̄
/// ∂θ/∂F with the law's dilatation θ projected onto the patch's pressure modes, θ̄ = Σ_k ψ_k Σ_I w ψ_k θ, which is the
/// variation of Σ_I w K/2 θ̄²: no volumetric locking. A tissue that swells by a stretch s, F = s F_e, has the energy
/// s³ W(F_e) and the stress s² P(F_e) (Rodriguez, Hoger & McCulloch 1994). All threads; the result does not depend on
/// their number. Where laws.prony is not empty each call is a time step of the viscous states.
void internal_force(const PointBlocks& points, const PointLaws& laws, const NodalVectors& parameters,
                    ForceScratch& scratch, NodalVectors& force);

/// Over all points, at the last internal_force().
JacobianRange jacobian_range(const ForceScratch& scratch);

/// State of the points at the parameters of the last internal_force().
struct PointState {
  double strain_energy = 0;  ///< 1e-9 J; of the elastic laws, without what relaxation took
  double smallest_jacobian = 1;
  double largest_stretch = 1;
  double compressed_share = 0;  ///< of the volume, with a principal stretch below crease_stretch
  double pressed_share = 0;     ///< of the volume, under a pressure of more than most_pressure
};
PointState point_state(const PointBlocks& points, const PointLaws& laws, const ForceScratch& scratch);

}  // namespace brainshift::solve
