// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "discretise/interface/background_cells.hpp"
#include "segmentation/geometry/surface.hpp"

namespace brainshift::solve {

/// The boundary of cells that fill the body whole: their faces that no other cell has, outward. Of planar cells their
/// edges, drawn out along z to strips as high as the edge is long. Empty when a cell lies in the body in part only, as
/// the body's boundary is then not that of the cells.
Surface cell_boundary(const BackgroundCells& cells);

}  // namespace brainshift::solve
