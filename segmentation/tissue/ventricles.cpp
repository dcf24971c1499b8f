// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/tissue/ventricles.hpp"

#include <algorithm>
#include <functional>

namespace brainshift::segmentation {
namespace {

Mask deeper_than(const ScalarImage& depths, double limit) {
  Mask mask{depths.geometry, std::vector<std::uint8_t>(depths.voxels.size())};
  std::transform(depths.voxels.begin(), depths.voxels.end(), mask.voxels.begin(),
                 [limit](float value) { return static_cast<std::uint8_t>(value > limit); });
  return mask;
}

// Shares of the brain's volume: as long as fewer ventricles are found, thicker sheets are opened away; and the smallest
// body that counts. In adults 12 and 0.3 ml.
constexpr double sought_ventricles = 0.008, smallest_body = 0.0002;

// For each body whether it counts as ventricle. smallest: voxels.
std::vector<bool> chosen_bodies(const Components& bodies, const ScalarImage& depths, double ventricle_depth,
                                double smallest) {
  std::vector<std::size_t> deep(bodies.sizes.size());
  for (std::size_t i = 0; i < bodies.number.size(); ++i) {
    if (bodies.number[i] != 0 && depths.voxels[i] >= ventricle_depth) {
      ++deep[static_cast<std::size_t>(bodies.number[i] - 1)];
    }
  }
  for (std::size_t body = 0; body < deep.size(); ++body) {
    if (2 * deep[body] > bodies.sizes[body]) {
      smallest = std::max(smallest, static_cast<double>(bodies.sizes[body]) / 20);
    }
  }
  std::vector<bool> chosen(deep.size());
  for (std::size_t body = 0; body < deep.size(); ++body) {
    const std::size_t size = bodies.sizes[body];
    chosen[body] = 2 * deep[body] > size && static_cast<double>(size) >= smallest;
  }
  return chosen;
}

// The voxels of the CSF near the core: the core before it was eroded, without what hung on it by sheets.
Mask grown_back(const Mask& core, const Mask& csf, double distance) {
  const ScalarImage away = depth(complement(core));
  Mask grown = csf;
  for (std::size_t i = 0; i < grown.voxels.size(); ++i) {
    grown.voxels[i] = csf.voxels[i] != 0 && away.voxels[i] <= distance ? 1 : 0;
  }
  return grown;
}

// The ventricles after sheets of half this thickness (mm) are opened away.
Mask loose_at(double sheet, const Mask& csf, const ScalarImage& csf_depths, const ScalarImage& brain_depths,
              double ventricle_depth, std::size_t brain_voxels) {
  Mask core = deeper_than(csf_depths, sheet);
  const Components bodies = components(core);
  const auto chosen =
      chosen_bodies(bodies, brain_depths, ventricle_depth, smallest_body * static_cast<double>(brain_voxels));
  for (std::size_t i = 0; i < core.voxels.size(); ++i) {
    core.voxels[i] = bodies.number[i] != 0 && chosen[static_cast<std::size_t>(bodies.number[i] - 1)] ? 1 : 0;
  }
  return count(core) == 0 ? core : grown_back(core, csf, 1.5 * sheet);
}

}  // namespace

Mask find_ventricles(const Mask& csf, const Mask& brain, double ventricle_depth) {
  const Mask brain_part = cropped(brain, 1);  // distances are found on a grid, whose voxels they cost
  const Mask csf_part = cropped_to(csf, brain_part.geometry);
  const ScalarImage brain_depths = depth(brain_part);
  const ScalarImage csf_depths = depth(csf_part);
  const double thinnest = 1.1 * std::max(1.0, csf.geometry.spacing.minCoeff());
  const std::size_t brain_voxels = count(brain_part);
  Mask found{brain_part.geometry, std::vector<std::uint8_t>(brain_part.voxels.size())};
  for (const double times : {1.0, 1.5, 2.0, 2.5, 3.0}) {
    const Mask loose = loose_at(times * thinnest, csf_part, csf_depths, brain_depths, ventricle_depth, brain_voxels);
    std::transform(loose.voxels.begin(), loose.voxels.end(), found.voxels.begin(), found.voxels.begin(),
                   std::bit_or<std::uint8_t>());
    if (static_cast<double>(count(found)) >= sought_ventricles * static_cast<double>(brain_voxels)) {
      break;
    }
  }
  return uncropped(found, csf.geometry);
}

}  // namespace brainshift::segmentation
