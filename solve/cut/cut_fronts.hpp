// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/cut/inside_body.hpp"
#include "solve/shape/visibility.hpp"

namespace brainshift::solve {

/// Finds where facets end inside the body: the tips of paths, the rims of sheets. An end nearer than half the spacing
/// of the nodes, mm, to the body's surface or to another piece of the cut reaches it and is no front: what is left
/// between them would be narrower than any node sees. A path's end at the body's surface is taken beyond it.
void find_fronts(const InsideBody& inside, double spacing, CutFacets& cut);

/// Splits the triangles of a sheet whose rim near the body is longer than that, mm, so that a front lies along the part
/// of it that is inside.
void split_long_rims(double longest, const InsideBody& inside, CutFacets& sheet);

}  // namespace brainshift::solve
