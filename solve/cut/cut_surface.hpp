// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "solve/cut/inside_body.hpp"
#include "solve/solution.hpp"

namespace brainshift::solve {

/// The two faces of a cut inside the body, drawn half a spacing fine: lines in a plane problem, triangles in space.
struct CutSurface {
  Points vertices;                 ///< undeformed, mm: those of the face above, then the same of that below
  Triangles facets;                ///< of a line the third vertex is -1
  Points displacement;             ///< of the face at each vertex, mm
  std::vector<std::int32_t> side;  ///< of each vertex: 1 above, on the side of the cut's normal; -1 below
};

/// Of a solution's cut; a facet whose middle is outside the body is left out. Throws as parameters_from_displacement().
CutSurface cut_surface(const Solution& solution, const InsideBody& inside);

/// A .vtp: undeformed points with the arrays `displacement` and `side`. Throws std::runtime_error, naming the file,
/// when it cannot be written whole.
void write_cut_surface(const std::filesystem::path& file, const CutSurface& surface);

}  // namespace brainshift::solve
