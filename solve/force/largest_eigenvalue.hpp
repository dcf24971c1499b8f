// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "solve/force/internal_force.hpp"

namespace brainshift::solve {

/// Largest eigenvalue of M⁻¹K of the undeformed body by power iteration from a rough start, mass in g (or µN/mm), one a
/// node: A_max of METHOD.md (25), in 1/s² (or 1). It comes from below: forty iterations are some percent short, a few
/// hundred nearly exact. Deterministic.
double largest_eigenvalue(const PointBlocks& points, const PointLaws& laws, std::span<const double> mass,
                          int iterations);

/// Its start: numbers without a pattern, the same each time; 4 a node.
NodalVectors rough_mode(std::size_t nodes);
inline constexpr double small_mode = 1e-7;  ///< root mean square of the modes, mm: small enough to stay linear

inline constexpr int tightness_iterations = 40;
inline constexpr double tightness_margin = 1.25;  ///< power iteration comes from below, and tangents turn

/// How much of a bound D of the stiffness is real: A_max of the undeformed body by a short power iteration with a
/// margin of a quarter, over the bound's own max D_a/m_a; at most one. 2 / sqrt(tightness · max D_a/m_a) is then the
/// critical step, where D is followed as the body deforms.
double bound_tightness(const PointBlocks& points, const PointLaws& laws, std::span<const double> bound,
                       std::span<const double> mass);

}  // namespace brainshift::solve
