// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "register/field/brain_zones.hpp"
#include "register/interface/input.hpp"

namespace brainshift::registration {

/// Offsets of the voxels whose tissue was taken out, ascending: those of the cavity, and those that carry a label of
/// what went and lie within a voxel's diagonal of its wall, which is smoother than the labels. labels: on the zones'
/// grid; null: the wall alone tells.
std::vector<std::size_t> cavity_voxels(const BrainZones& zones, const Cavity& cavity, const ImageGeometry& geometry,
                                       const LabelMap* labels);

/// The image with a value in some voxels.
template <class T>
Image<T> emptied(Image<T> image, const std::vector<std::size_t>& voxels, T value) {
  for (const std::size_t voxel : voxels) {
    image.voxels[voxel] = value;
  }
  return image;
}

}  // namespace brainshift::registration
