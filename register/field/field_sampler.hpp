// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include "register/field/field_grid.hpp"
#include "segmentation/image/image.hpp"

namespace brainshift::registration {

/// Trilinear interpolation of a vector image, as ITK's does it: on the outermost half voxel the value is that of the
/// outermost voxel. Positions are continuous voxel indices. Holds no copy: the image must outlive it.
class FieldSampler {
 public:
  explicit FieldSampler(const VectorImage& field)
      : field_(field), origin_(field.geometry.origin), index_from_world_(field.geometry.index_from_world()) {}

  const VectorImage& field() const { return field_; }

  /// Valid as long as the image's voxels stay where they are.
  FieldGrid grid() const { return {field_.geometry.size, origin_, index_from_world_, field_.voxels.data()}; }

  /// ∂index/∂world, 1/mm: turns a displacement into voxels.
  const Eigen::Matrix3d& index_from_world() const { return index_from_world_; }

  Eigen::Vector3d to_index(const Eigen::Vector3d& world) const { return index_from_world_ * (world - origin_); }

  bool inside(const Eigen::Vector3d& index) const { return grid().inside(index); }

  /// Displacement, mm. Beyond the image: that of its nearest place.
  Eigen::Vector3d value(const Eigen::Vector3d& index) const { return grid().value(index); }

  /// The same, and its derivative by the index (column = axis), mm a voxel.
  Eigen::Vector3d value_and_gradient(const Eigen::Vector3d& index, Eigen::Matrix3d& gradient) const {
    return grid().value_and_gradient(index, gradient);
  }

 private:
  const VectorImage& field_;
  Eigen::Vector3d origin_;
  Eigen::Matrix3d index_from_world_;
};

}  // namespace brainshift::registration
