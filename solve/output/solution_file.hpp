// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "solve/interface/solution.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift {

/// The shape functions that the solution was computed with.
solve::ShapeFunctions shape_functions(const Solution& solution);

/// solution.vtu: one vertex cell a node; point arrays displacement, reaction_force, spacing and, where there is an
/// estimate, estimated_error; field arrays shape_basis (0 linear, 1 quadratic, 2 modified quadratic), shape_dilatation,
/// shape_penalty and shape_planar (0 or 1); of a body that is cut, too, cut_vertices (3), cut_facets (3, of a segment
/// the third is -1) and cut_front (2). On reading, everything but displacement may be absent (another program's
/// solution): no force, the mean distance to the six nearest nodes, the default shape options. Throws
/// std::invalid_argument, naming the file and what is wrong.
Solution read_solution(const std::filesystem::path& file);
void write_solution(const std::filesystem::path& file, const Solution& solution);

}  // namespace brainshift
