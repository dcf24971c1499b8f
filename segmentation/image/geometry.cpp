// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Dense>
#include <cmath>

#include "segmentation/image/image.hpp"

namespace brainshift {

Eigen::Vector3d ImageGeometry::to_world(const Eigen::Vector3d& index) const {
  return origin + direction * spacing.cwiseProduct(index);
}

Eigen::Vector3d ImageGeometry::to_index(const Eigen::Vector3d& world) const {
  const Eigen::Matrix3d inverse = direction.inverse();
  return (inverse * (world - origin)).cwiseQuotient(spacing);
}

bool same_geometry(const ImageGeometry& a, const ImageGeometry& b) {
  if ((a.size != b.size).any()) {
    return false;
  }
  const double tolerance = 1e-3 * std::min(a.spacing.minCoeff(), b.spacing.minCoeff());
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Array3i picked(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
    const Eigen::Vector3d index = (picked * (a.size - 1)).cast<double>().matrix();
    const double distance = (a.to_world(index) - b.to_world(index)).norm();
    if (!(distance <= tolerance)) {
      return false;
    }
  }
  return true;
}

std::int16_t label_at(const LabelMap& labels, const Eigen::Vector3d& world) {
  const ImageGeometry& geometry = labels.geometry;
  const Eigen::Vector3d index = geometry.to_index(world);
  Eigen::Array3i nearest;
  for (int axis = 0; axis < 3; ++axis) {
    const bool inside = index[axis] >= -0.5 && index[axis] <= geometry.size[axis] - 0.5;
    if (!inside) {
      return 0;
    }
    nearest[axis] = std::clamp(static_cast<int>(std::lround(index[axis])), 0, geometry.size[axis] - 1);
  }
  return labels.at(nearest.x(), nearest.y(), nearest.z());
}

}  // namespace brainshift
