// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <variant>

#include "solve/material/linear_elastic.hpp"
#include "solve/material/neo_hookean.hpp"
#include "solve/material/ogden.hpp"
#include "solve/material/saint_venant_kirchhoff.hpp"

namespace brainshift::solve {

/// A law ready for the solver. Each has W(F) = W_iso(F) + K/2 θ(F)² with its own dilatation θ, so that the points of a
/// patch can share one θ, and answers the same questions: shear_modulus, bulk_modulus, isochoric_stress,
/// isochoric_energy, dilatation, dilatation_slope, least_dilatation, largest_tangent. The stress is
/// P = isochoric_stress + Kθ dilatation_slope. Resolve it (std::visit) once per block of points.
using ElasticLaw = std::variant<NeoHookean, Ogden, SaintVenantKirchhoff, LinearElastic>;

/// The law of a material that check_material accepts, its instantaneous response where it relaxes.
ElasticLaw elastic_law(const Material& material);

}  // namespace brainshift::solve
