// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/ensemble/each_force.hpp"

namespace brainshift::solve {

/// bound_tightness() of each member, with the bounds as masses.
Numbers bound_tightness_of_each(EachForce& force, const EachNumbers& bound);

}  // namespace brainshift::solve
