// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <cmath>

#include "segmentation/geometry/grid_cell.hpp"
#include "segmentation/image/image.hpp"

namespace brainshift::registration {

/// A displacement as the fields hold it: rounded to 1/4096 mm, far below any error of the method. The files compress to
/// a quarter of what unrounded numbers take.
inline std::array<float, 3> stored(const Eigen::Vector3d& displacement) {
  constexpr double steps = 4096;  // a millimetre
  const auto round = [](double u) { return static_cast<float>(std::round(u * steps) / steps); };
  return {round(displacement.x()), round(displacement.y()), round(displacement.z())};
}

/// Trilinear interpolation of a vector image, as ITK's does it: on the outermost half voxel the value is that of the
/// outermost voxel. Positions are continuous voxel indices. Holds no copy: the image must outlive it.
class FieldSampler {
 public:
  explicit FieldSampler(const VectorImage& field)
      : field_(field),
        origin_(field.geometry.origin),
        index_from_world_((field.geometry.direction * field.geometry.spacing.asDiagonal()).inverse()) {}

  const VectorImage& field() const { return field_; }

  /// ∂index/∂world, 1/mm: turns a displacement into voxels.
  const Eigen::Matrix3d& index_from_world() const { return index_from_world_; }

  Eigen::Vector3d to_index(const Eigen::Vector3d& world) const { return index_from_world_ * (world - origin_); }

  bool inside(const Eigen::Vector3d& index) const {
    const Eigen::Array3d high = field_.geometry.size.cast<double>() - 0.5;
    return (index.array() >= -0.5).all() && (index.array() <= high).all();
  }

  /// Displacement, mm. Beyond the image: that of its nearest place.
  Eigen::Vector3d value(const Eigen::Vector3d& index) const {
    const GridCell cell(field_.geometry.size, index);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int corner = 0; corner < 8; ++corner) {
      sum += cell.weight(corner) * at(cell.offset(corner));
    }
    return sum;
  }

  /// The same, and its derivative by the index (column = axis), mm a voxel.
  Eigen::Vector3d value_and_gradient(const Eigen::Vector3d& index, Eigen::Matrix3d& gradient) const {
    const GridCell cell(field_.geometry.size, index);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    gradient.setZero();
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d u = at(cell.offset(corner));
      sum += cell.weight(corner) * u;
      for (int axis = 0; axis < 3; ++axis) {
        gradient.col(axis) += cell.slope(corner, axis) * u;
      }
    }
    return sum;
  }

 private:
  Eigen::Vector3d at(std::size_t offset) const {
    const auto& u = field_.voxels[offset];
    return {u[0], u[1], u[2]};
  }

  const VectorImage& field_;
  Eigen::Vector3d origin_;
  Eigen::Matrix3d index_from_world_;
};

}  // namespace brainshift::registration
