// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "solve/force/internal_force.hpp"

namespace brainshift::solve {

/// A diagonal D (µN/mm, one a node) with uᵀKu ≤ uᵀDu for the stiffness K at the last internal_force(). With D as the
/// mass the critical step is at least 2; with the physical mass m it is at least 2 / sqrt(max D_a/m_a).
///
/// By Cauchy-Schwarz with weights h_a |B_a|, per point for the tangent C of the change of shape (and the pressure's
/// geometric part), and per patch and pressure mode ψ_k for that of volume with b_a = Σ_I w ψ_k (∂θ/∂F) B_a:
///   w C |Σ_a B_a ⊗ u_a|² ≤ w C ‖Σ_b B_b ⊗ B_b / (h_b |B_b|)‖ Σ_a h_a |B_a| |u_a|²,
///   K |Σ_a b_a · u_a|²   ≤ K (Σ_b |b_b|/h_b) Σ_a h_a |b_a| |u_a|².
/// Over a patch derivatives of opposite sign cancel in b; a bound point by point, as Wittek et al., eq. 23, does not
/// see that. Any h > 0 will do: they are those of NodeShares, with the reach |B_a| at a point, Σ_I w |B_a| over a
/// patch.
std::vector<double> stiffness_bound(const PointBlocks& points, const PointLaws& laws, const ForceScratch& scratch);

/// ‖Σ_b B_b ⊗ B_b / (h_b |B_b|)‖, the largest eigenvalue; share: the h_b.
double weighted_norm(const Eigen::Matrix3Xd& b, std::span<const double> share);

/// 2 / sqrt(max D_a/m_a), s.
double critical_step(std::span<const double> stiffness_bound, std::span<const double> mass);

}  // namespace brainshift::solve
