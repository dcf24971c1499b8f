// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "discretise/body/scanlines.hpp"
#include "discretise/cells/cell_grid.hpp"
#include "discretise/sizing/sizing_field.hpp"
#include "discretise/sizing/tissue_lookup.hpp"

namespace brainshift::discretise {

/// Regular hexahedra of the given edge, mm, over the body, aligned with the axes of the world and not with the body:
/// those the surface cuts keep the volumes and centroids of their octants' inside parts, integrated along lines through
/// the cell (exact along x, 8 × 8 lines). Where the sizing field asks for finer nodes a cell is split, once for each
/// halving of the spacing.
CellGrid cut_hexahedra(const Surface& surface, const Scanlines& body, const SizingField& sizing,
                       const TissueLookup& tissue, double edge);

}  // namespace brainshift::discretise
