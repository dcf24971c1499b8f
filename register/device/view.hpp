// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "register/device/fit.hpp"
#include "register/device/node_bins.hpp"
#include "register/field/brain_zones.hpp"
#include "segmentation/geometry/distance_grid.hpp"
#include "segmentation/geometry/on_device.hpp"

namespace brainshift::registration::device {

using Displacement = std::array<float, 3>;

/// What becomes of a voxel.
struct Part {
  static constexpr std::uint8_t near = 1;     ///< has the solver's displacement, in the brain or near it
  static constexpr std::uint8_t hollow = 2;   ///< of a cavity, far from its wall: spanned from wall to wall
  static constexpr std::uint8_t outside = 4;  ///< smoothed and faded
};

/// An ImageGeometry's part that a device needs.
struct VoxelGrid {
  Eigen::Array3i size;
  Eigen::Vector3d spacing, origin;
  Eigen::Matrix3d direction, index_from_world;

  BRAINSHIFT_ON_DEVICE std::size_t count() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]);
  }
  BRAINSHIFT_ON_DEVICE std::size_t offset(const Eigen::Array3i& at) const {
    const auto nx = static_cast<std::size_t>(size[0]), ny = static_cast<std::size_t>(size[1]);
    return static_cast<std::size_t>(at[0]) +
           nx * (static_cast<std::size_t>(at[1]) + ny * static_cast<std::size_t>(at[2]));
  }
  /// Offsets of images on a device fit into 31 bits, and dividing longer numbers takes a GPU long.
  BRAINSHIFT_ON_DEVICE Eigen::Array3i place(std::size_t offset) const {
    const auto at = static_cast<std::uint32_t>(offset), nx = static_cast<std::uint32_t>(size[0]);
    const std::uint32_t row = at / nx, ny = static_cast<std::uint32_t>(size[1]);
    return {static_cast<int>(at - row * nx), static_cast<int>(row % ny), static_cast<int>(row / ny)};
  }
  BRAINSHIFT_ON_DEVICE Eigen::Vector3d world(const Eigen::Array3i& at) const {
    const Eigen::Vector3d index = at.cast<double>().matrix();
    return origin + direction * spacing.cwiseProduct(index);
  }
};

/// What is counted on the way.
struct Counts {
  std::int32_t left;          ///< voxels whose support is to be grown, or is large
  std::int32_t lost;          ///< of them those for which there is none
  std::int32_t not_inverted;  ///< voxels where the inversion missed its tolerance
};

/// What the tasks read and change, as it lies in the memory of a device: plain arrays, one entry a voxel where nothing
/// else is said.
struct View {
  VoxelGrid grid;
  NodeView nodes;
  FitRules rules;
  DistanceGrid outside;  ///< of the brain
  DistanceGrid wall;     ///< of a cavity; without samples: there is none
  double reach, fade;    ///< mm
  double tolerance;      ///< of the inversion, mm
  const Zone* zone;
  std::uint8_t* part;
  Displacement* field;  ///< forward, as far as it has come
  Displacement* next;   ///< what a sweep makes of it
  Displacement* resampling;
  std::int32_t* left;  ///< offsets of voxels, in any order; of those that are lost -1 - offset
  Counts* counts;
  const float* image;
  float* warped;
  const std::uint16_t* labels;
  std::uint16_t* warped_labels;
};

}  // namespace brainshift::registration::device
