// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solve/dynamics/nodal_vectors.hpp"
#include "solve/dynamics/point_blocks.hpp"
#include "solve/dynamics/point_laws.hpp"

namespace brainshift::solve {

/// What has become of J at the points; NaN where one is.
struct JacobianRange {
  double smallest = 1;
  double least_ratio = 1;  ///< of J to that of the internal_force() before; 1 where it is not followed
};

/// Scratch of internal_force(), made once and reused in every step, and what points remember between steps.
struct ForceScratch {
  std::vector<double> slot_displacement;        ///< 4 a slot
  std::vector<double> slot_force;               ///< 4 a slot
  std::vector<double> gradient;                 ///< 9 a point: F, kept between the two passes over a patch
  std::vector<double> jacobian;                 ///< transient: J of each point
  std::vector<JacobianRange> block_jacobian;    ///< one a block
  std::vector<double> thickness;                ///< plane stress: F_33 of each point, where the next search starts
  std::vector<std::size_t> viscous_begin = {};  ///< transient with Prony terms: offset of each point's state
  std::vector<double> viscous_state = {};

  ForceScratch(const PointBlocks& points, const PointLaws& laws);

  /// Takes over what the points of another remember; from: the number there of each point here.
  void remember(const ForceScratch& other, std::span<const std::int32_t> from);

  std::size_t viscous_bytes() const { return bytes(viscous_begin) + bytes(viscous_state); }
  /// All but what relaxing materials remember.
  std::size_t scratch_bytes() const {
    return bytes(slot_displacement) + bytes(slot_force) + bytes(gradient) + bytes(jacobian) + bytes(block_jacobian) +
           bytes(thickness);
  }
};

/// f_int,a = Σ_I w P B_a (µN) at parameters û (mm); P the first Piola–Kirchhoff stress. Its volumetric part is K θ̄
/// ∂θ/∂F with the law's dilatation θ projected onto the patch's pressure modes, θ̄ = Σ_k ψ_k Σ_I w ψ_k θ, which is the
/// variation of Σ_I w K/2 θ̄²: no volumetric locking. All threads; the result does not depend on their number. Where
/// laws.prony is not empty each call is a time step of the viscous states.
void internal_force(const PointBlocks& points, const PointLaws& laws, const NodalVectors& parameters,
                    ForceScratch& scratch, NodalVectors& force);

/// Over all points, at the last internal_force().
JacobianRange jacobian_range(const ForceScratch& scratch);

/// Below this stretch a free face of soft matter creases under uniaxial compression (Hong, Zhao & Suo 2009).
inline constexpr double crease_stretch = 0.56;

/// State of the points at the parameters of the last internal_force().
struct PointState {
  double strain_energy = 0;  ///< 1e-9 J; of the elastic laws, without what relaxation took
  double smallest_jacobian = 1;
  double largest_stretch = 1;
  double compressed_share = 0;  ///< of the volume, with a principal stretch below crease_stretch
};
PointState point_state(const PointBlocks& points, const PointLaws& laws, const ForceScratch& scratch);

}  // namespace brainshift::solve
