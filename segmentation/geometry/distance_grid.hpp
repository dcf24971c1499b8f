// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "segmentation/geometry/grid_cell.hpp"
#include "segmentation/geometry/on_device.hpp"

namespace brainshift {

/// The samples of a SignedDistance, and how it answers from them.
struct DistanceGrid {
  double spacing;  ///< mm
  Eigen::Vector3d origin;
  Eigen::Array3i size;
  const float* sample;  ///< mm, x fastest

  /// As SignedDistance::value().
  BRAINSHIFT_ON_DEVICE double value(const Eigen::Vector3d& position) const {
    const Eigen::Array3d wanted = index_of(position);
    const Eigen::Array3d inside = wanted.max(0.0).min((size - 1).cast<double>());
    const GridCell cell(size, wanted);
    const double sampled = cell.interpolate([this](std::size_t offset) { return sample[offset]; });
    const bool within = (wanted == inside).all();  // as nearly always: spares a root
    return within ? sampled : sampled + spacing * (wanted - inside).matrix().norm();
  }

  /// As SignedDistance::gradient().
  BRAINSHIFT_ON_DEVICE Eigen::Vector3d gradient(const Eigen::Vector3d& position) const {
    const Eigen::Array3d index = index_of(position);
    const bool inner = is_inner(index);
    Eigen::Vector3d difference;
    std::size_t stride = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d half = 0.5 * Eigen::Vector3d::Unit(axis);
      if (inner) {  // what the trilinear value differs by: the samples' differences, interpolated
        const GridCell cell(size, index.matrix() - half);
        difference[axis] = cell.interpolate(
            [&](std::size_t offset) { return double{sample[offset + stride]} - double{sample[offset]}; });
        stride *= static_cast<std::size_t>(size[axis]);
      } else {
        difference[axis] = value(position + spacing * half) - value(position - spacing * half);
      }
    }
    // Beyond the horizon the distance is the same everywhere, but for rounding: it has no direction there.
    const double norm = difference.norm();
    return norm > 1e-6 * spacing ? Eigen::Vector3d(difference / norm) : Eigen::Vector3d(0, 0, 0);
  }

  /// Of a position, in grid steps.
  BRAINSHIFT_ON_DEVICE Eigen::Array3d index_of(const Eigen::Vector3d& position) const {
    return (position - origin).array() / spacing;
  }

  /// Whether all samples within one and a half grid steps are there.
  BRAINSHIFT_ON_DEVICE bool is_inner(const Eigen::Array3d& index) const {
    return (index >= 1).all() && (index < (size - 2).cast<double>()).all();
  }
};

}  // namespace brainshift
