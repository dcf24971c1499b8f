// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/cut/inside_body.hpp"
#include "solve/shape/visibility.hpp"

namespace brainshift::solve {

/// Finds where facets end inside the body: the tips of paths, the rims of sheets. An end nearer than half the spacing
/// of the nodes, mm, to the body's surface or to another piece of the cut reaches it and is no front: what is left
/// between them would be narrower than any node sees. A path's end at the body's surface is taken beyond it; triangles
/// with a long rim are split, so that a front lies along the part of the rim that is inside.
void find_fronts(const InsideBody& inside, double spacing, CutFacets& cut);

}  // namespace brainshift::solve
