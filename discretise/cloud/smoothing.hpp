// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "discretise/body/scanlines.hpp"
#include "discretise/cloud/random.hpp"
#include "discretise/sizing/sizing_field.hpp"

namespace brainshift::discretise {

/// One sweep of centroidal patch smoothing: Delaunay tetrahedra of all nodes (CGAL), then each node from row `first` on
/// moves to the middle of the tetrahedra around it, weighted with the density that the sizing field asks for. A move
/// out of the body is not made. (Chen 2004, Mesh smoothing schemes based on optimal Delaunay triangulations.)
void smooth(Points& nodes, Eigen::Index first, const Scanlines& body, const SizingField& sizing);

/// One sweep against slivers (flat Delaunay tetrahedra of well spread nodes): a node from row `first` on of each sliver
/// moves a tenth of its edges in a random direction.
/// (Li 2000, Sliver-free perturbation for the Delaunay refinement.)
void shake_slivers(Points& nodes, Eigen::Index first, const Scanlines& body, Random& random);

}  // namespace brainshift::discretise
