// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/geometry/points.hpp"
#include "solve/arrays/nodal_vectors.hpp"
#include "solve/interface/model.hpp"
#include "solve/quadrature/integration_points.hpp"
#include "solve/shape/shape_rows.hpp"

namespace brainshift::solve {

/// Adds the force of a point load at a node, N, spread as virtual work has it: Vᵀ f, V the shape functions at the
/// nodes. force (n × 3); total in µN, 4 a node.
void add_nodal_force(const Points& force, const ShapeRows& nodal_rows, NodalVectors& total);

/// Adds f_a = Σ_I w φ_a(X_I) b(X_I).
void add_body_force(const BodyForce& body_force, const IntegrationPoints& points, const ShapeRows& rows,
                    NodalVectors& total);

}  // namespace brainshift::solve
