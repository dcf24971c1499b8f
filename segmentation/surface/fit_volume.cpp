// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <cmath>

#include "segmentation/surface/extract.hpp"

namespace brainshift::segmentation {
namespace {

// Twice the area vector of each triangle, summed over the triangles of each vertex.
Points vertex_normals(const Surface& surface, double& area) {
  Points normals = Points::Zero(surface.vertices.rows(), 3);
  area = 0;
  for (const auto& triangle : surface.triangles.rowwise()) {
    const Eigen::Vector3d a = surface.vertices.row(triangle[0]);
    const Eigen::Vector3d b = surface.vertices.row(triangle[1]);
    const Eigen::Vector3d c = surface.vertices.row(triangle[2]);
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    area += 0.5 * normal.norm();
    for (const std::int32_t corner : triangle) {
      normals.row(corner) += normal.transpose();
    }
  }
  return normals.rowwise().normalized();
}

}  // namespace

void fit_volume(Surface& surface, double wanted) {
  constexpr int most_rounds = 10;
  for (int round = 0; round < most_rounds; ++round) {
    const double missing = wanted - volume(surface);
    if (std::abs(missing) <= 1e-4 * wanted) {
      return;
    }
    double area = 0;
    const Points normals = vertex_normals(surface, area);
    surface.vertices += missing / area * normals;
  }
}

}  // namespace brainshift::segmentation
