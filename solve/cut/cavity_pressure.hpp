// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "solve/quadrature/integration_points.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift::solve {

/// The force of a pressure (Pa) in a cavity on the wall about it, (nodes × 3) N, by the divergence theorem:
///   f_a = p ∫_wall φ_a n dA = p Σ_I w_I (r_I − s_a) ∂φ_a(X_I)/∂X, n out of the cavity,
/// r_I 1 at the points of the cavity (removed), else 0, and s_a the share of the node's points that are. Without s_a it
/// would push on where the cavity lies open, too. Of a closed cavity s_a changes nothing but the integration's error,
/// which it keeps in proportion to how much of a node what is left sees. rows: of the points, with derivatives, in the
/// body as it was.
Points cavity_force(const IntegrationPoints& points, std::span<const std::uint8_t> removed, const ShapeRows& rows,
                    Eigen::Index nodes, double pressure);

}  // namespace brainshift::solve
