// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <cmath>

#include "segmentation/surface/extract.hpp"

namespace brainshift::segmentation {
namespace {

// Weighted with the areas of the triangles around.
Points vertex_normals(const Surface& surface) {
  Points normals = Points::Zero(surface.vertices.rows(), 3);
  for (const auto& triangle : surface.triangles.rowwise()) {
    const Eigen::Vector3d a = surface.vertices.row(triangle[0]);
    const Eigen::Vector3d b = surface.vertices.row(triangle[1]);
    const Eigen::Vector3d c = surface.vertices.row(triangle[2]);
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    for (const std::int32_t corner : triangle) {
      normals.row(corner) += normal.transpose();
    }
  }
  return normals.rowwise().normalized();
}

}  // namespace

void fit_volume(Surface& surface, double wanted) {
  constexpr int most_rounds = 50;
  for (int round = 0; round < most_rounds; ++round) {
    const double missing = wanted - volume(surface);
    if (std::abs(missing) <= 1e-4 * wanted) {
      return;
    }
    surface.vertices += missing / area(surface) * vertex_normals(surface);
  }
}

}  // namespace brainshift::segmentation
