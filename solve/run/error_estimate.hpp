// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solve/interface/solution.hpp"

namespace brainshift::solve {

/// What the displacement may be wrong by at each node for want of nodes, mm: the share of its distance from the coarse
/// solution that the finer spacing leaves, root mean square over the nodes within two spacings, as two fields may
/// cross. coarse: displacement at the cloud's nodes, (n × 3) mm. Nodes of the solution beyond, and those in their
/// places, lie on the two faces of a cut or septum, of which a place does not tell one: they go by the others. wider:
/// spacing of the coarse nodes over that of the cloud. It knows nothing of loads, materials or images that are wrong.
std::vector<double> estimated_error(const Solution& solution, const Points& coarse, double wider);

}  // namespace brainshift::solve
