// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "discretise/interface/background_cells.hpp"
#include "segmentation/geometry/surface.hpp"

namespace brainshift::solve {

/// The boundary of cells that fill the body whole: their faces that no other cell has, outward. Of planar cells their
/// edges, drawn out along z to strips as high as the edge is long. Empty when a cell lies in the body in part only, as
/// the body's boundary is then not that of the cells.
Surface cell_boundary(const BackgroundCells& cells);

/// Edges in the plane z = 0, two vertices each, drawn out to such strips.
Surface strips(const Points& vertices, std::span<const std::array<std::int32_t, 2>> edges);

}  // namespace brainshift::solve
