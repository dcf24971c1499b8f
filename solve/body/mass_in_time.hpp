// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solve/body/body_parts.hpp"

namespace brainshift::solve {

/// Masses of a motion in time, g, one a node, all above 0: row sums Σ_I w ρ φ_a of the consistent mass. Those of
/// quadratic functions may be none or less at an edge. Such a node gets a tenth of its even share, which sets the step,
/// and that is taken from the nodes that share its points, so that the whole weighs what the tissue does; but of none
/// more than half of its mass.
std::vector<double> mass_in_time(const BodyParts& parts);

}  // namespace brainshift::solve
