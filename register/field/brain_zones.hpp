// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "segmentation/geometry/signed_distance.hpp"
#include "segmentation/geometry/surface.hpp"
#include "segmentation/image/image.hpp"

namespace brainshift::registration {

/// What a voxel is to the brain's surface.
enum class Zone : std::uint8_t {
  beyond,  ///< farther than the fade: does not move
  fading,  ///< outside the brain: moves with the nearest place of its surface, less with the distance
  shell,   ///< outside, but within two voxel diagonals of the surface: places within one are interpolated from it
  cavity,  ///< in the brain, of tissue that was taken out
  brain,
};

/// The zones of an image's voxels, and the distance that the fading ones are told by.
struct BrainZones {
  std::vector<Zone> zone;                   ///< one a voxel
  SignedDistance outside;                   ///< mm from the brain's surface, negative inside
  double shell;                             ///< thickness of the shell: two voxel diagonals, mm
  std::optional<SignedDistance> wall = {};  ///< of what was taken out, negative in it; absent: nothing was
};

/// Throws std::invalid_argument when the fade is not wider than the shell that an image of this geometry has.
void check_fade(double fade, const ImageGeometry& geometry);

/// Throws std::invalid_argument when the surface is not closed or encloses no voxel, or when the fade is not wider than
/// the shell. wall: of what was taken out, closed; null: nothing was.
BrainZones brain_zones(const Surface& brain, const ImageGeometry& geometry, double fade, const Surface* wall = nullptr);

}  // namespace brainshift::registration
