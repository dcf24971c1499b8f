// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/surface.hpp"

#include <Eigen/Geometry>

namespace brainshift {

Eigen::Vector3d Triangle::area_vector() const {
  return 0.5 * (b - a).cross(c - a);
}

Triangle triangle(const Surface& surface, Eigen::Index t) {
  const auto corner = surface.triangles.row(t);
  return {surface.vertices.row(corner[0]), surface.vertices.row(corner[1]), surface.vertices.row(corner[2])};
}

Points vertex_normals(const Surface& surface) {
  Points normals = Points::Zero(surface.vertices.rows(), 3);
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    const Eigen::RowVector3d area = triangle(surface, t).area_vector();
    for (const std::int32_t corner : surface.triangles.row(t)) {
      normals.row(corner) += area;
    }
  }
  return normals;
}

double volume(const Surface& surface) {
  double six_volumes = 0;
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    const auto& [a, b, c] = triangle(surface, t);
    six_volumes += a.dot(b.cross(c));
  }
  return six_volumes / 6.0;
}

double area(const Surface& surface) {
  double sum = 0;
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    sum += triangle(surface, t).area_vector().norm();
  }
  return sum;
}

}  // namespace brainshift
