// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "discretise/interface/background_cells.hpp"

namespace brainshift::discretise {

/// Cells, and what was left out of them.
struct CellGrid {
  BackgroundCells cells;
  std::size_t dropped_cells = 0;  ///< cut hexahedra with a negligible inside part, flat tetrahedra
  double dropped_volume = 0;      ///< inside volume of those, mm³
};

/// Volume of the inside parts of hexahedra, which are boxes, or tetrahedra, mm³.
double inside_volume(const BackgroundCells& cells);

}  // namespace brainshift::discretise
