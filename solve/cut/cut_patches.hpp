// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/quadrature/pressure_patches.hpp"
#include "solve/shape/visibility.hpp"

namespace brainshift::solve {

/// Parts the patches whose points do not all see each other, directly or over others of the patch: pressures do not
/// reach across a cut. positions (n × 3) of the integration points, mm.
PressurePatches part_patches(const Visibility& visibility, const Points& positions, const PressurePatches& patches);

}  // namespace brainshift::solve
