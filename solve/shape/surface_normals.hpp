// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "segmentation/geometry/surface.hpp"

namespace brainshift::solve {

/// Directions that the boundary's area vector ∫ψ n dA may take at nodes on it: one where it is smooth, two at an edge,
/// three in a corner.
struct SurfaceNormals {
  std::vector<Eigen::Matrix3d> direction;  ///< orthonormal columns, as many as the rank
  std::vector<int> rank;                   ///< 1 to 3; 3 too where the boundary is too far away to say
};

/// The normals of that part of the boundary to which the node is nearest, along the boundary. positions: of the nodes
/// on the surface (n × 3), mm; spacing: of each, mm. Nodes at one place, as on the faces of a cut, have the same. An
/// edge is one from about 25° on.
SurfaceNormals surface_normals(std::span<const Surface> boundary, const Points& positions,
                               std::span<const double> spacing);

}  // namespace brainshift::solve
