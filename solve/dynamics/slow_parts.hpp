// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solve/body/body.hpp"
#include "solve/force/internal_force.hpp"

namespace brainshift::solve {

using NodeLists = std::vector<std::vector<std::int32_t>>;

/// The stiff parts of which conditions see no node. RigidModes may move these, the first most_parts of them.
NodeLists free_stiff_parts(const Body& body);

/// All others.
NodeLists parts_without_modes(const Body& body);

/// û with the stiff parts moved as rigid bodies, each as near as may be to where û, mm, takes it: an answer that comes
/// from a coarser cloud may strain them.
NodalVectors with_rigid_parts(const Body& body, NodalVectors parameters);

/// The least eigenvalue of M⁻¹K of a rigid motion of any of these parts, by Rayleigh's quotients within the six of
/// each; infinite without parts. K is that of the tissue at û = now, mm. mass: one a node. scratch: of the internal
/// force, at `now` afterwards.
double slowest_rigid_motion(const Body& body, const NodeLists& parts, std::span<const double> mass,
                            const NodalVectors& now, ForceScratch& scratch);

}  // namespace brainshift::solve
