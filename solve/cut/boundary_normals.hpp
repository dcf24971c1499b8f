// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "solve/body/ordered_cloud.hpp"
#include "solve/interface/model.hpp"
#include "solve/shape/shape_functions.hpp"
#include "solve/shape/surface_normals.hpp"

namespace brainshift::solve {

/// The model's boundary, or that of its cells where they fill the body whole. Without triangles where neither is known,
/// or where a resection leaves a wall that no surface describes.
Surface known_boundary(const Model& model);

/// At the cloud's nodes on the surface: of the boundary and of the faces of the cuts; all directions at nodes that see
/// one of a face which is held in all of them. nodal_rows: shape functions at all nodes. Absent where the boundary is
/// unknown.
std::optional<SurfaceNormals> boundary_normals(const Surface& boundary, const CutFacets& cut, const OrderedCloud& cloud,
                                               const ShapeRows& nodal_rows);

}  // namespace brainshift::solve
