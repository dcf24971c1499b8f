// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/surface/surface.hpp"

#include <Eigen/Geometry>

namespace brainshift {

double volume(const Surface& surface) {
  double six_volumes = 0;
  for (const auto& triangle : surface.triangles.rowwise()) {
    const Eigen::Vector3d a = surface.vertices.row(triangle[0]);
    const Eigen::Vector3d b = surface.vertices.row(triangle[1]);
    const Eigen::Vector3d c = surface.vertices.row(triangle[2]);
    six_volumes += a.dot(b.cross(c));
  }
  return six_volumes / 6.0;
}

double area(const Surface& surface) {
  double sum = 0;
  for (const auto& triangle : surface.triangles.rowwise()) {
    const Eigen::Vector3d a = surface.vertices.row(triangle[0]);
    const Eigen::Vector3d b = surface.vertices.row(triangle[1]);
    const Eigen::Vector3d c = surface.vertices.row(triangle[2]);
    sum += 0.5 * (b - a).cross(c - a).norm();
  }
  return sum;
}

}  // namespace brainshift
