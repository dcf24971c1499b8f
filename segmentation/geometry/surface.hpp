// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "segmentation/geometry/points.hpp"

namespace brainshift {

/// Vertex indices of triangles, (n × 3), counter-clockwise seen from outside.
using Triangles = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// A triangulated surface. What the segment stage writes is closed, 2-manifold, free of self-intersection, and its
/// normals point outward; what a user hands in need not be.
struct Surface {
  Points vertices;
  Triangles triangles;
};

/// The corners of a triangle, mm.
struct Triangle {
  Eigen::Vector3d a, b, c;

  /// Normal by the order of the corners, as long as the triangle has area, mm².
  Eigen::Vector3d area_vector() const;
  Eigen::Vector3d centroid() const { return (a + b + c) / 3; }
};

/// The t-th triangle of a surface.
Triangle triangle(const Surface& surface, Eigen::Index t);

/// With its inside out.
inline Surface turned_over(Surface surface) {
  surface.triangles.col(1).swap(surface.triangles.col(2));
  return surface;
}

/// Normals at the vertices, (n × 3), each the sum of its triangles' area vectors, mm²: not of unit length.
Points vertex_normals(const Surface& surface);

/// Volume enclosed by a closed surface, mm³, by the divergence theorem; positive when the triangles face outward.
double volume(const Surface& surface);

/// The longest edge, mm, of the box around the triangles, along x, y and z; 0 without a triangle.
double extent(const Surface& surface);

/// Whether the triangles lie in one plane, line or point, to a millionth of their extent.
bool is_flat(const Surface& surface);

/// Area of the triangles, mm².
double area(const Surface& surface);

}  // namespace brainshift
