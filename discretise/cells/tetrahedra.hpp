// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "discretise/body/scanlines.hpp"
#include "discretise/cells/cell_grid.hpp"
#include "discretise/sizing/tissue_lookup.hpp"

namespace brainshift::discretise {

/// The Delaunay tetrahedra of the nodes that lie in the body (more than half of the places looked at within them), all
/// positive; flat ones between nodes of the surface hold no volume and are left out.
CellGrid inside_tetrahedra(const Points& nodes, const Scanlines& body, const TissueLookup& tissue);

}  // namespace brainshift::discretise
