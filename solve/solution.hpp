// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "segmentation/surface/surface.hpp"
#include "solve/cut/visibility.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift {

/// What leaves the solve stage: the displacement at the nodes, u = Σφû, never the parameters û.
struct Solution {
  Points positions;             ///< undeformed nodes, mm, LPS, in the cloud's order
  Points displacement;          ///< mm
  Points reaction_force;        ///< N; zero at nodes where nothing is prescribed
  std::vector<double> spacing;  ///< of the cloud, mm: with the shape options it gives back the shape functions
  ShapeOptions shape;           ///< the shape functions it was computed with
  solve::CutFacets cut = {};    ///< that parts the body; none: empty
};

/// The shape functions that the solution was computed with.
solve::ShapeFunctions shape_functions(const Solution& solution);

/// solution.vtu: one vertex cell a node; point arrays displacement, reaction_force, spacing; field arrays shape_basis
/// (0 linear, 1 quadratic, 2 modified quadratic), shape_dilatation, shape_penalty and shape_planar (0 or 1); of a body
/// that is cut, too, cut_vertices (3), cut_facets (3, of a segment the third is -1) and cut_front (2). On
/// reading, everything but displacement may be absent (another program's solution): no force, the mean distance to the
/// six nearest nodes, the default shape options. Throws std::invalid_argument, naming the file and what is wrong.
Solution read_solution(const std::filesystem::path& file);
void write_solution(const std::filesystem::path& file, const Solution& solution);

}  // namespace brainshift
