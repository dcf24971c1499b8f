// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "solve/dynamics/internal_force.hpp"

namespace brainshift::solve {

/// Largest eigenvalue of M⁻¹K of the undeformed body by power iteration from a rough start, mass in g (or µN/mm), one a
/// node: A_max of eq 18, in 1/s² (or 1). It comes from below: forty iterations are some percent short, a few hundred
/// nearly exact. Deterministic.
double largest_eigenvalue(const PointBlocks& points, const PointLaws& laws, std::span<const double> mass,
                          int iterations);

}  // namespace brainshift::solve
