// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/tissue/ventricles.hpp"

#include <algorithm>

namespace brainshift::segmentation {
namespace {

Mask deeper_than(const ScalarImage& depths, double limit) {
  Mask mask{depths.geometry, std::vector<std::uint8_t>(depths.voxels.size())};
  std::transform(depths.voxels.begin(), depths.voxels.end(), mask.voxels.begin(),
                 [limit](float value) { return static_cast<std::uint8_t>(value > limit); });
  return mask;
}

// For each body whether it counts as ventricle.
std::vector<bool> chosen_bodies(const Components& bodies, const ScalarImage& depths, double ventricle_depth) {
  std::vector<std::size_t> deep(bodies.sizes.size());
  for (std::size_t i = 0; i < bodies.number.size(); ++i) {
    if (bodies.number[i] != 0 && depths.voxels[i] >= ventricle_depth) {
      ++deep[static_cast<std::size_t>(bodies.number[i] - 1)];
    }
  }
  std::size_t largest = 0;
  for (std::size_t body = 0; body < deep.size(); ++body) {
    if (2 * deep[body] > bodies.sizes[body]) {
      largest = std::max(largest, bodies.sizes[body]);
    }
  }
  std::vector<bool> chosen(deep.size());
  for (std::size_t body = 0; body < deep.size(); ++body) {
    chosen[body] = 2 * deep[body] > bodies.sizes[body] && 20 * bodies.sizes[body] >= largest;
  }
  return chosen;
}

// The voxels of the CSF near the core: the core before it was eroded, without what hung on it by sheets.
Mask grown_back(const Mask& core, const Mask& csf, double distance) {
  Mask outside = core;
  for (std::uint8_t& voxel : outside.voxels) {
    voxel = voxel == 0 ? 1 : 0;
  }
  const ScalarImage away = depth(outside);
  Mask grown = csf;
  for (std::size_t i = 0; i < grown.voxels.size(); ++i) {
    grown.voxels[i] = csf.voxels[i] != 0 && away.voxels[i] <= distance ? 1 : 0;
  }
  return grown;
}

}  // namespace

Mask find_ventricles(const Mask& csf, const Mask& brain, double ventricle_depth) {
  const Mask brain_part = cropped(brain, 1);  // distances are found on a grid, whose voxels they cost
  const Mask csf_part = cropped_to(csf, brain_part.geometry);
  const double sheet = 1.1 * std::max(1.0, csf.geometry.spacing.minCoeff());  // half a sheet's thickness, mm
  Mask core = deeper_than(depth(csf_part), sheet);
  const Components bodies = components(core);
  const auto chosen = chosen_bodies(bodies, depth(brain_part), ventricle_depth);
  for (std::size_t i = 0; i < core.voxels.size(); ++i) {
    core.voxels[i] = bodies.number[i] != 0 && chosen[static_cast<std::size_t>(bodies.number[i] - 1)] ? 1 : 0;
  }
  return uncropped(count(core) == 0 ? core : grown_back(core, csf_part, 1.5 * sheet), csf.geometry);
}

}  // namespace brainshift::segmentation
