// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "discretise/interface/node_cloud.hpp"
#include "solve/body/ordered_cloud.hpp"
#include "solve/quadrature/integration_points.hpp"
#include "solve/shape/shape_rows.hpp"

namespace brainshift::solve {

/// Throws std::invalid_argument when two nodes lie in nearly one place, or `spacing` is not that of the nodes.
void check_cloud(const NodeCloud& cloud);

/// Throws std::invalid_argument when the integration points are too few for the nodes, in all or about a node, or lie
/// beyond the cloud: motions that strain no point cost nothing, and the answer would be soft without a word.
/// point_rows, nodal_rows: shape functions at the points and at the nodes. Returns how many points there are a node
/// where they are fewest, inside the body; infinite where all nodes are on the surface.
double check_points(const OrderedCloud& cloud, const IntegrationPoints& points, const ShapeRows& point_rows,
                    const ShapeRows& nodal_rows);

}  // namespace brainshift::solve
