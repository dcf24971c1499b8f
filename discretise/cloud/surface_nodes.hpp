// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "discretise/body/scanlines.hpp"
#include "discretise/cloud/random.hpp"
#include "discretise/sizing/sizing_field.hpp"

namespace brainshift::discretise {

/// Spreads `count` nodes over a closed surface, their density after the sizing field: random places that keep a
/// distance (Poisson disk), then a few sweeps of Lloyd's method on the surface (each node to the middle of the part of
/// the surface that is nearest to it); then those nearest to a rim, places on the surface, move onto it as
/// move_onto_boundary() moves them. spacing: the uniform one, mm. Each lies on the surface, within a millionth of
/// the spacing on its inner side, so that rounding puts none outside. Returns (about count × 3); fewer only where the
/// surface leaves no room.
Points spread_over_surface(const Surface& surface, const Scanlines& body, const SizingField& sizing, double spacing,
                           std::size_t count, const Points& rim, Random& random);

/// ∫ factor⁻² dA over the surface, mm²: proportional to the number of nodes that it takes.
double surface_demand(const Surface& surface, const SizingField& sizing);

}  // namespace brainshift::discretise
