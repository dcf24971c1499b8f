// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/brain_zones.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "segmentation/image/voxels.hpp"

namespace brainshift::registration {

namespace {

/// Two voxel diagonals.
double shell_of(const ImageGeometry& geometry) {
  return 2 * geometry.spacing.norm();
}

Zone zone_at(double distance, double shell, double fade) {
  if (distance <= 0) {
    return Zone::brain;
  }
  if (distance <= shell) {
    return Zone::shell;
  }
  return distance < fade ? Zone::fading : Zone::beyond;
}

}  // namespace

void check_fade(double fade, const ImageGeometry& geometry) {
  const double shell = shell_of(geometry);
  if (!(fade > shell)) {
    std::ostringstream text;
    text << "register's fade is " << fade << " mm, but must be wider than two voxel diagonals of the T1 (" << shell
         << " mm); the default is 20 mm";
    throw std::invalid_argument(text.str());
  }
}

BrainZones brain_zones(const Surface& brain, const ImageGeometry& geometry, double fade, const Surface* wall) {
  const double shell = shell_of(geometry);
  check_fade(fade, geometry);
  SignedDistanceOptions options;
  options.margin = fade + options.spacing;
  BrainZones zones{std::vector<Zone>(geometry.voxel_count(), Zone::beyond), SignedDistance(brain, options), shell};
  if (wall != nullptr) {
    zones.wall.emplace(*wall);
  }
  for_each_voxel_in_parallel(geometry.size, [&](int i, int j, int k) {
    const Eigen::Vector3d place = geometry.to_world(Eigen::Vector3d(i, j, k));
    Zone& zone = zones.zone[geometry.offset(i, j, k)];
    zone = zone_at(zones.outside.value(place), zones.shell, fade);
    if (zones.wall && zone == Zone::brain && zones.wall->value(place) < 0) {
      zone = Zone::cavity;
    }
  });
  if (std::find(zones.zone.begin(), zones.zone.end(), Zone::brain) == zones.zone.end()) {
    throw std::invalid_argument(
        "the brain's surface encloses no voxel of the image; are both of the same head and in the same frame?");
  }
  return zones;
}

}  // namespace brainshift::registration
