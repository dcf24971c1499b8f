// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>

#include "segmentation/surface/surface.hpp"
#include "solve/dynamics/nodal_vectors.hpp"
#include "solve/quadrature/integration_points.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift::solve {

/// Force per undeformed volume at an undeformed place (mm) and label, N/mm³.
using BodyForce = std::function<Eigen::Vector3d(const Eigen::Vector3d& position, std::int32_t label)>;

/// Adds the force of a point load at a node, N, spread as virtual work has it: Vᵀ f, V the shape functions at the
/// nodes. force (n × 3); total in µN, 4 a node.
void add_nodal_force(const Points& force, const ShapeRows& nodal_rows, NodalVectors& total);

/// Adds f_a = Σ_I w φ_a(X_I) b(X_I).
void add_body_force(const BodyForce& body_force, const IntegrationPoints& points, const ShapeRows& rows,
                    NodalVectors& total);

}  // namespace brainshift::solve
