// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/surface.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace brainshift {

namespace {

// Three rows a triangle; vertices of no triangle are left out.
Points corners_of(const Surface& surface) {
  Points corners(surface.triangles.size(), 3);
  for (Eigen::Index t = 0; t < surface.triangles.size(); ++t) {
    corners.row(t) = surface.vertices.row(surface.triangles.data()[t]);
  }
  return corners;
}

double extent_of(const Points& corners) {
  return corners.rows() == 0 ? 0.0 : (corners.colwise().maxCoeff() - corners.colwise().minCoeff()).maxCoeff();
}

}  // namespace

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

double extent(const Surface& surface) {
  return extent_of(corners_of(surface));
}

bool is_flat(const Surface& surface) {
  Points corners = corners_of(surface);
  const double across = extent_of(corners);
  if (!(across > 0)) {
    return true;
  }
  corners.rowwise() -= Eigen::RowVector3d(corners.row(0));
  corners /= across;
  corners.rowwise() -= Eigen::RowVector3d(corners.colwise().mean());
  const Eigen::Matrix3d spread = corners.transpose() * corners / static_cast<double>(corners.rows());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread, Eigen::EigenvaluesOnly);
  constexpr double least = 1e-6;
  return !(axes.eigenvalues().minCoeff() > least * least);
}

double area(const Surface& surface) {
  double sum = 0;
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    sum += triangle(surface, t).area_vector().norm();
  }
  return sum;
}

}  // namespace brainshift
