// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "segmentation/geometry/grid_cell.hpp"
#include "segmentation/geometry/on_device.hpp"

namespace brainshift::registration {

/// A displacement as the fields hold it: rounded to 1/4096 mm, far below any error of the method. The files compress to
/// a quarter of what unrounded numbers take.
BRAINSHIFT_ON_DEVICE inline std::array<float, 3> stored(const Eigen::Vector3d& displacement) {
  constexpr double steps = 4096;  // a millimetre
  const auto round = [](double u) { return static_cast<float>(std::round(u * steps) / steps); };
  return {round(displacement.x()), round(displacement.y()), round(displacement.z())};
}

/// The voxels of a displacement field, and how a FieldSampler answers from them.
struct FieldGrid {
  Eigen::Array3i size;
  Eigen::Vector3d origin;
  Eigen::Matrix3d index_from_world;    ///< ∂index/∂world, 1/mm
  const std::array<float, 3>* voxels;  ///< mm, x fastest

  BRAINSHIFT_ON_DEVICE Eigen::Vector3d to_index(const Eigen::Vector3d& world) const {
    return index_from_world * (world - origin);
  }

  BRAINSHIFT_ON_DEVICE bool inside(const Eigen::Vector3d& index) const {
    const Eigen::Array3d high = size.cast<double>() - 0.5;
    return (index.array() >= -0.5).all() && (index.array() <= high).all();
  }

  BRAINSHIFT_ON_DEVICE Eigen::Vector3d value(const Eigen::Vector3d& index) const {
    const GridCell cell(size, index);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int corner = 0; corner < 8; ++corner) {
      sum += cell.weight(corner) * at(cell.offset(corner));
    }
    return sum;
  }

  BRAINSHIFT_ON_DEVICE Eigen::Vector3d value_and_gradient(const Eigen::Vector3d& index,
                                                          Eigen::Matrix3d& gradient) const {
    const GridCell cell(size, index);
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

  BRAINSHIFT_ON_DEVICE Eigen::Vector3d at(std::size_t offset) const {
    const std::array<float, 3>& u = voxels[offset];
    return {u[0], u[1], u[2]};
  }
};

}  // namespace brainshift::registration
