// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "solve/arrays/nodal_vectors.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift::solve {

/// Displacement at the nodes, u = Σφû, in the order of the rows, mm.
NodalVectors displacement_of(const ShapeRows& nodal_rows, const NodalVectors& parameters);

/// Of any values at the nodes, (n × 3), their sums Σφv at the rows' points, (rows × 3).
Points values_of(const ShapeRows& rows, const Points& nodal);

/// displacement_of() in the cloud's order.
Points nodal_displacement(const ShapeRows& nodal_rows, const NodalVectors& parameters,
                          const std::vector<std::int32_t>& original);

}  // namespace brainshift::solve
