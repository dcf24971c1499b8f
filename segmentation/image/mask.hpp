// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "segmentation/image/image.hpp"
#include "segmentation/image/voxels.hpp"

namespace brainshift {

using Mask = Image<std::uint8_t>;  ///< 1 inside, 0 outside

/// The voxels that carry one of the labels.
Mask mask_of(const LabelMap& labels, std::span<const std::uint16_t> wanted);

/// The voxels that are not zero.
Mask mask_of(const LabelMap& labels);

/// Calls visit(voxel), an Eigen::Array3i, for each voxel inside, in the order of storage.
template <class Visit>
void for_each_inside(const Mask& mask, const Visit& visit) {
  const Eigen::Array3i size = mask.geometry.size;
  for_each_voxel(size, [&](int i, int j, int k) {
    if (mask.at(i, j, k) != 0) {
      visit(Eigen::Array3i(i, j, k));
    }
  });
}

std::size_t count(const Mask& mask);

/// 1 where the mask is 0.
Mask complement(Mask mask);

/// Volume of the voxels inside, mm³.
double volume(const Mask& mask);

/// Whether a voxel inside lies on the image's outermost layer.
bool touches_border(const Mask& mask);

/// The part of the image around the mask, with a margin of so many voxels on each side, along each axis, whether the
/// image reaches that far or not. The voxels keep their places in the world. The mask must not be empty.
Mask cropped(const Mask& mask, const Eigen::Array3i& margin);
inline Mask cropped(const Mask& mask, int margin) {
  return cropped(mask, Eigen::Array3i::Constant(margin));
}

/// How many voxels along each axis reach so far, mm.
inline Eigen::Array3i voxels_to(double distance, const ImageGeometry& grid) {
  return (distance / grid.spacing.array()).ceil().cast<int>();
}

/// What another mask of the same image has on the grid of a part that was cropped from it.
Mask cropped_to(const Mask& mask, const ImageGeometry& part);

/// A mask cropped before, back on the grid that it was cut from.
Mask uncropped(const Mask& mask, const ImageGeometry& grid);

/// Components joined through faces, numbered from 1 in the order of their first voxels. number: one a voxel, 0 outside
/// the mask; sizes: voxels, of number 1 first.
struct Components {
  std::vector<std::int32_t> number;
  std::vector<std::size_t> sizes;
};
Components components(const Mask& mask);

/// The component of most voxels; the first of equals. The mask must not be empty.
Mask largest_component(const Mask& mask);

/// Fills what cannot be reached from the image's outside through faces.
Mask holes_filled(const Mask& mask);

/// With what lies within the radius (mm) of it. The mask must not be empty, here and below.
Mask grown(const Mask& mask, double radius);

/// Morphological closing: with every gap that a ball of the radius (mm) does not fit into.
Mask closed(const Mask& mask, double radius);

/// How far each voxel's centre lies inside the mask, to the nearest voxel centre outside it, mm; 0 outside the mask.
ScalarImage depth(const Mask& mask);

}  // namespace brainshift
