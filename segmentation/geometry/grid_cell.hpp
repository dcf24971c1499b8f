// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>

#include "segmentation/geometry/on_device.hpp"

namespace brainshift {

/// The eight points of a regular grid (x fastest) around a place, for trilinear interpolation. Beyond the grid the
/// place counts as the nearest one of the grid, and along an axis of one point nothing changes, as in ITK.
class GridCell {
 public:
  /// index: continuous, in grid steps; not a number counts as 0.
  BRAINSHIFT_ON_DEVICE GridCell(const Eigen::Array3i& size, const Eigen::Vector3d& index) {
    std::size_t stride = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const double last = size[axis] - 1.0;
      const double x = std::min(std::max(0.0, index[axis]), last);  // this order turns NaN into 0
      const int low = std::max(0, std::min(static_cast<int>(x), size[axis] - 2));
      base_ += static_cast<std::size_t>(low) * stride;
      step_[axis] = size[axis] > 1 ? stride : 0;
      share_[axis] = x - low;
      varies_[axis] = size[axis] > 1 && index[axis] >= 0 && index[axis] <= last ? 1 : 0;
      stride *= static_cast<std::size_t>(size[axis]);
    }
  }

  /// Where a corner, 0 to 7, stands among the grid's values.
  BRAINSHIFT_ON_DEVICE std::size_t offset(int corner) const {
    std::size_t sum = base_;
    for (int axis = 0; axis < 3; ++axis) {
      sum += is_high(corner, axis) ? step_[axis] : 0;
    }
    return sum;
  }
  BRAINSHIFT_ON_DEVICE double weight(int corner) const {
    return along(corner, 0) * along(corner, 1) * along(corner, 2);
  }
  /// Derivative of the weight by the index along an axis; 0 where the place is beyond the grid along it.
  BRAINSHIFT_ON_DEVICE double slope(int corner, int axis) const {
    const double sign = is_high(corner, axis) ? varies_[axis] : -varies_[axis];
    return sign * along(corner, (axis + 1) % 3) * along(corner, (axis + 2) % 3);
  }

  /// Σ weight · value(offset) over the corners.
  template <class Value>
  BRAINSHIFT_ON_DEVICE double interpolate(const Value& value) const {
    const auto along_x = [&](std::size_t at) { return (1 - share_[0]) * value(at) + share_[0] * value(at + step_[0]); };
    const auto along_y = [&](std::size_t at) {
      return (1 - share_[1]) * along_x(at) + share_[1] * along_x(at + step_[1]);
    };
    return (1 - share_[2]) * along_y(base_) + share_[2] * along_y(base_ + step_[2]);
  }

 private:
  BRAINSHIFT_ON_DEVICE static bool is_high(int corner, int axis) { return ((corner >> axis) & 1) != 0; }
  BRAINSHIFT_ON_DEVICE double along(int corner, int axis) const {
    return is_high(corner, axis) ? share_[axis] : 1 - share_[axis];
  }

  std::size_t base_ = 0;
  std::size_t step_[3];
  double share_[3];   // of the way to the higher corner
  double varies_[3];  // 1, or 0 where the value is held constant along the axis
};

}  // namespace brainshift
