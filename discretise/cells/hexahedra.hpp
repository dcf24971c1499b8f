// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "discretise/background_cells.hpp"
#include "discretise/body/scanlines.hpp"
#include "discretise/sizing/sizing_field.hpp"
#include "discretise/sizing/tissue_lookup.hpp"

namespace brainshift::discretise {

/// Cells, and what was left out of them.
struct CellGrid {
  BackgroundCells cells;
  std::size_t dropped_cells = 0;  ///< cut cells with a negligible inside part
  double dropped_volume = 0;      ///< inside volume of those, mm³
};

/// Regular hexahedra of the given edge, mm, over the body, aligned with the axes of the world and not with the body:
/// those the surface cuts keep the volumes and centroids of their octants' inside parts, integrated along lines through
/// the cell (exact along x, 8 × 8 lines). Where the sizing field asks for finer nodes a cell is split, once for each
/// halving of the spacing.
CellGrid cut_hexahedra(const Surface& surface, const Scanlines& body, const SizingField& sizing,
                       const TissueLookup& tissue, double edge);

}  // namespace brainshift::discretise
