// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/jacobian.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "segmentation/image/voxels.hpp"

namespace brainshift::registration {

namespace {

/// ∂u/∂index at a voxel, column = axis, mm a voxel.
Eigen::Matrix3d gradient_by_index(const VectorImage& field, const Eigen::Array3i& voxel) {
  Eigen::Matrix3d gradient;
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Array3i low = voxel, high = voxel;
    low[axis] = std::max(0, voxel[axis] - 1);
    high[axis] = std::min(field.geometry.size[axis] - 1, voxel[axis] + 1);
    const auto& a = field.at(low.x(), low.y(), low.z());
    const auto& b = field.at(high.x(), high.y(), high.z());
    const double steps = std::max(1, high[axis] - low[axis]);
    gradient.col(axis) = Eigen::Vector3d(b[0] - a[0], b[1] - a[1], b[2] - a[2]) / steps;
  }
  return gradient;
}

}  // namespace

ScalarImage jacobian(const VectorImage& forward) {
  const ImageGeometry& g = forward.geometry;
  const Eigen::Matrix3d index_from_world = g.index_from_world();
  ScalarImage result{g, std::vector<float>(g.voxel_count())};
  for_each_voxel_in_parallel(g.size, [&](int i, int j, int k) {
    const Eigen::Matrix3d by_world = gradient_by_index(forward, {i, j, k}) * index_from_world;
    result.at(i, j, k) = static_cast<float>((Eigen::Matrix3d::Identity() + by_world).determinant());
  });
  return result;
}

}  // namespace brainshift::registration
