// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "segmentation/image/mask.hpp"

namespace brainshift {
namespace {

// On a grid that holds all of it.
Mask grown_part(const Mask& mask, double radius) {
  Mask part = cropped(mask, voxels_to(radius, mask.geometry) + 1);
  const ScalarImage away = depth(complement(part));
  std::transform(away.voxels.begin(), away.voxels.end(), part.voxels.begin(),
                 [radius](float distance) { return static_cast<std::uint8_t>(distance <= radius); });
  return part;
}

}  // namespace

Mask grown(const Mask& mask, double radius) {
  return cropped_to(grown_part(mask, radius), mask.geometry);
}

Mask closed(const Mask& mask, double radius) {
  Mask part = grown_part(mask, radius);
  const ScalarImage inside = depth(part);
  std::transform(inside.voxels.begin(), inside.voxels.end(), part.voxels.begin(),
                 [radius](float distance) { return static_cast<std::uint8_t>(distance > radius); });
  Mask result = cropped_to(part, mask.geometry);
  std::transform(mask.voxels.begin(), mask.voxels.end(), result.voxels.begin(), result.voxels.begin(),
                 [](std::uint8_t was, std::uint8_t is) { return std::max(was, is); });
  return result;
}

}  // namespace brainshift
