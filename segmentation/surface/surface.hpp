// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <span>

namespace brainshift {

/// Points, (n × 3), one a row, mm, LPS.
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// Vertex indices of triangles, (n × 3), counter-clockwise seen from outside.
using Triangles = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// A triangulated surface. What the segment stage writes is closed, 2-manifold, free of self-intersection, and its
/// normals point outward; what a user hands in need not be.
struct Surface {
  Points vertices;
  Triangles triangles;
};

/// Volume enclosed by a closed surface, mm³, by the divergence theorem; positive when the triangles face outward.
double volume(const Surface& surface);

/// Area of the triangles, mm².
double area(const Surface& surface);

/// Reads .vtp, .stl, .ply or .obj. Faces with more than three corners are triangulated, repeated points (STL) merged.
/// Coordinates are taken as LPS, unless the file carries 3D Slicer's note SPACE=RAS: then x and y change sign.
/// Throws std::invalid_argument, naming the file, when it cannot be read, holds no triangle or a non-finite coordinate.
Surface read_surface(const std::filesystem::path& file);

/// Writes by the file's ending (.vtp, .stl, .ply, .obj), with 3D Slicer's note SPACE=LPS; all but .stl keep doubles.
/// Throws std::runtime_error when the file cannot be written whole.
void write_surface(const std::filesystem::path& file, const Surface& surface);

}  // namespace brainshift
