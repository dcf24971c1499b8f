// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "discretise/cells/body_side.hpp"
#include "discretise/cells/cell_grid.hpp"
#include "discretise/sizing/sizing_field.hpp"

namespace brainshift::discretise {

/// Regular hexahedra of the given edge, mm, over the body, aligned with the axes of the world and not with the body:
/// those the surface cuts keep the volumes and centroids of their octants' inside parts, integrated along lines through
/// the cell (exact along x, 8 × 8 lines). Where the sizing field asks for finer nodes a cell is split, once for each
/// halving of the spacing. surfaces: the body's, then any other that parts its sides; a cube with a part on each of two
/// sides becomes two cells.
CellGrid cut_hexahedra(std::span<const Surface> surfaces, std::span<const BodySide> sides, const SizingField& sizing,
                       double edge);

}  // namespace brainshift::discretise
