// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "solve/dynamics/point_blocks.hpp"

namespace brainshift::solve {

/// Masses for dynamic relaxation (µN/mm), one a node, such that the largest eigenvalue of M⁻¹K is at most one whatever
/// the state of the points within the given tangent moduli (Pa, one a point): m_a = Σ_I w C |B_a| Σ_b |B_b|. By
/// Cauchy-Schwarz
///   uᵀK_I u ≤ w C |Σ_a B_a u_a|² ≤ w C (Σ_b |B_b|)(Σ_a |B_a| |u_a|²),
/// so every point's share has the same critical step, 2.
std::vector<double> relaxation_mass(const PointBlocks& points, std::span<const double> tangent_moduli);

/// The conservative critical step of eq 25 (s) with the physical mass: min over points of 2 / (c_d sqrt(N Σ|B|²)).
/// wave_speed: c_d = sqrt((λ + 2µ)/ρ), mm/s, one a material.
double critical_step(const PointBlocks& points, std::span<const double> wave_speed);

}  // namespace brainshift::solve
