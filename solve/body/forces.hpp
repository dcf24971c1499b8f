// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/body/body_parts.hpp"
#include "solve/boundary/external_force.hpp"
#include "solve/interface/model.hpp"
#include "solve/interface/options.hpp"

namespace brainshift::solve {

/// Forces on the parameters of a body of these parts. In a transient run the fluid's level sinks with the load's curve,
/// from the top of the body on; to rest only where it ends counts.
ExternalForce external_force(const Model& model, const BodyParts& parts, Dynamics dynamics);

}  // namespace brainshift::solve
