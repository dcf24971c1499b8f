// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "register/field/brain_zones.hpp"
#include "register/interface/input.hpp"

namespace brainshift::registration {

/// Throws std::invalid_argument where the solution is not of this brain: a fifth of the brain's surface, without that
/// of what was taken out, lies over two spacings from every node, or a twentieth of the nodes so far outside the brain.
/// Between and beyond nodes the field would be made up.
void check_covers(const RegisterInput& input, const BrainZones& zones);

}  // namespace brainshift::registration
