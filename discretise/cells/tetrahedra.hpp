// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "discretise/cells/body_side.hpp"
#include "discretise/cells/cell_grid.hpp"

namespace brainshift::discretise {

/// The Delaunay tetrahedra of the nodes that lie in the body (more than half of the places looked at within them), all
/// positive; flat ones between nodes of the surface hold no volume and are left out. One is of the side that its middle
/// lies in, else of the first.
CellGrid inside_tetrahedra(const Points& nodes, const Scanlines& body, std::span<const BodySide> sides);

}  // namespace brainshift::discretise
