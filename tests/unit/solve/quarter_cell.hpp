// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/unit/solve/clouds.hpp"

namespace brainshift::test {

/// A cube of that side that the surface cuts at a quarter of it along x.
inline BackgroundCells cell_cut_at_a_quarter(double side) {
  BackgroundCells cells = box_cells(1, side);
  cells.inside_fraction = {0.25};  // x below side/4
  cells.cut_index = {0};
  InsideOctants part{};
  for (const std::size_t octant : {0u, 2u, 4u, 6u}) {
    part.volume[octant] = side * side * side / 16;
    part.centroid[octant][0] = side / 8;
    part.centroid[octant][1] = octant & 2 ? 0.75 * side : 0.25 * side;
    part.centroid[octant][2] = octant & 4 ? 0.75 * side : 0.25 * side;
  }
  cells.cut_parts = {part};
  return cells;
}

}  // namespace brainshift::test
