// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "register/field/brain_zones.hpp"
#include "segmentation/image/image.hpp"
#include "solve/interface/solution.hpp"

namespace brainshift::registration {

/// Throws std::invalid_argument where the solution is not of this brain: a twentieth of the brain lies over two
/// spacings from every node, or of the nodes so far outside the brain. Between and beyond nodes the field would be made
/// up.
void check_covers(const Solution& solution, const BrainZones& zones, const ImageGeometry& geometry);

}  // namespace brainshift::registration
