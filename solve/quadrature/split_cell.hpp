// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solve/quadrature/gauss_points.hpp"

namespace brainshift::solve {

/// The parts that a cell is split into by halving its edges: eight of a hexahedron or tetrahedron, four of a
/// quadrilateral or triangle, of the same kind and orientation; hexahedra in the order of InsideOctants.
std::vector<Corners> split_cell(CellKind kind, const Corners& corners);

}  // namespace brainshift::solve
