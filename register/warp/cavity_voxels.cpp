// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/warp/cavity_voxels.hpp"

#include <algorithm>

#include "segmentation/image/voxels.hpp"

namespace brainshift::registration {

std::vector<std::size_t> cavity_voxels(const BrainZones& zones, const Cavity& cavity, const ImageGeometry& geometry,
                                       const LabelMap* labels) {
  const double diagonal = geometry.spacing.norm();
  const auto went = [&](std::size_t voxel) {
    return labels != nullptr && std::ranges::find(cavity.labels, labels->voxels[voxel]) != cavity.labels.end();
  };
  std::vector<std::size_t> voxels;
  for_each_voxel(geometry.size, [&](int i, int j, int k) {
    const std::size_t voxel = geometry.offset(i, j, k);
    if (zones.zone[voxel] == Zone::cavity ||
        (went(voxel) && zones.wall->value(geometry.to_world(Eigen::Vector3d(i, j, k))) < diagonal)) {
      voxels.push_back(voxel);
    }
  });
  return voxels;
}

}  // namespace brainshift::registration
