// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "segmentation/geometry/surface.hpp"
#include "segmentation/geometry/triangle_distance.hpp"

namespace brainshift {

/// Outward normals (not of unit length) of the faces, edges and vertices of a closed surface, such that the sign of
/// (p - nearest point) · normal of its part says on which side p lies (Bærentzen & Aanæs 2005): that of an edge is the
/// sum of its two faces', that of a vertex the sum of its faces' weighted by their angles.
struct Pseudonormals {
  Triangles triangles;
  std::vector<Eigen::Vector3d> face;                 ///< one a triangle
  std::vector<std::array<Eigen::Vector3d, 3>> edge;  ///< three a triangle: ab, bc, ca
  std::vector<Eigen::Vector3d> vertex;               ///< one a vertex

  const Eigen::Vector3d& of(std::size_t triangle, TrianglePart part) const;
};

/// Of each triangle, unit; zero where it has no area.
std::vector<Eigen::Vector3d> face_normals(const Surface& surface);
/// Of each vertex of any surface, not of unit length: the sum of its faces', weighted by their angles, where
/// vertex_normals() weighs them by their areas.
std::vector<Eigen::Vector3d> angle_weighted_normals(const Surface& surface, const std::vector<Eigen::Vector3d>& face);

/// Throws std::invalid_argument on a surface that is empty, not finite, open, not 2-manifold along an edge, or inside
/// out.
Pseudonormals pseudonormals(const Surface& surface);

}  // namespace brainshift
