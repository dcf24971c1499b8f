// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>

#include "register/device/view.hpp"
#include "segmentation/geometry/on_device.hpp"

namespace brainshift::registration::device {

/// The image at an index in it, as itk::LinearInterpolateImageFunction has it, to the bit: along x, then y, then z, and
/// on the outermost half voxel that of the outermost voxel.
BRAINSHIFT_ON_DEVICE inline float interpolated(const VoxelGrid& grid, const float* image,
                                               const Eigen::Vector3d& index) {
  std::size_t base = 0, stride = 1, step[3];
  double share[3];
  for (int axis = 0; axis < 3; ++axis) {
    const int floor = static_cast<int>(std::floor(index[axis])), low = floor < 0 ? 0 : floor;
    share[axis] = index[axis] > low ? index[axis] - low : 0;
    step[axis] = low + 1 < grid.size[axis] ? stride : 0;
    base += static_cast<std::size_t>(low) * stride;
    stride *= static_cast<std::size_t>(grid.size[axis]);
  }
  const auto along_x = [&](std::size_t at) {
    const double low = image[at], high = image[at + step[0]];
    return low + (high - low) * share[0];
  };
  const auto along_y = [&](std::size_t at) {
    const double low = along_x(at), high = along_x(at + step[1]);
    return low + (high - low) * share[1];
  };
  const double low = along_y(base), high = along_y(base + step[2]);
  return static_cast<float>(low + (high - low) * share[2]);
}

BRAINSHIFT_ON_DEVICE inline std::uint16_t nearest(const VoxelGrid& grid, const std::uint16_t* labels,
                                                  const Eigen::Vector3d& index) {
  const Eigen::Array3i last = grid.size - 1;
  const Eigen::Array3i at = (index.array() + 0.5).floor().cast<int>().max(0).min(last);
  return labels[grid.offset(at)];
}

/// A voxel of an image on the field's own grid, by where it was; look_up(grid, image, index).
template <class T, class LookUp>
BRAINSHIFT_ON_DEVICE T resampled(const VoxelGrid& grid, const Displacement* resampling, const T* image,
                                 std::size_t offset, const LookUp& look_up) {
  const Displacement& d = resampling[offset];
  if (d[0] == 0 && d[1] == 0 && d[2] == 0) {
    return image[offset];  // bit for bit
  }
  const Eigen::Vector3d index = grid.place(offset).cast<double>().matrix();
  const Eigen::Vector3d preop = index + grid.index_from_world * Eigen::Vector3d(d[0], d[1], d[2]);
  const Eigen::Array3d high = grid.size.cast<double>() - 0.5;
  const bool inside = (preop.array() >= -0.5).all() && (preop.array() <= high).all();
  return inside ? look_up(grid, image, preop) : T{0};
}

}  // namespace brainshift::registration::device
