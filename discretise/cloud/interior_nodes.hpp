// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "discretise/body/scanlines.hpp"
#include "discretise/cloud/random.hpp"
#include "discretise/sizing/sizing_field.hpp"

namespace brainshift::discretise {

/// Fills the body with `count` nodes, their density after the sizing field: random places that keep a distance from
/// each other and from the nodes on the surface (Poisson disk), then a few sweeps that move each to the middle of its
/// Delaunay tetrahedra (centroidal patch smoothing). spacing: the uniform one, mm. Returns (count × 3), all inside.
Points fill_interior(const Points& surface_nodes, const Scanlines& body, const SizingField& sizing, double spacing,
                     std::size_t count, Random& random);

/// ∫ factor⁻³ dV over the body, mm³: proportional to the number of nodes that it takes.
double volume_demand(const Surface& surface, const Scanlines& body, const SizingField& sizing);

}  // namespace brainshift::discretise
