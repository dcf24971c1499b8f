// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/mask.hpp"

#include <algorithm>
#include <numeric>

namespace brainshift {
namespace {

struct Box {
  Eigen::Array3i lower;
  Eigen::Array3i upper;  // inclusive
};

Box bounding_box(const Mask& mask) {
  Box box{mask.geometry.size, Eigen::Array3i::Constant(-1)};
  for_each_inside(mask, [&](const Eigen::Array3i& voxel) {
    box.lower = box.lower.min(voxel);
    box.upper = box.upper.max(voxel);
  });
  return box;
}

// Index of the first voxel of `part` on the grid of `whole`.
Eigen::Array3i shift_between(const ImageGeometry& whole, const ImageGeometry& part) {
  return whole.to_index(part.origin).array().round().cast<int>();
}

}  // namespace

Mask mask_of(const LabelMap& labels, std::span<const std::uint16_t> wanted) {
  Mask mask{labels.geometry, std::vector<std::uint8_t>(labels.voxels.size())};
  std::transform(labels.voxels.begin(), labels.voxels.end(), mask.voxels.begin(), [&](std::uint16_t label) {
    return static_cast<std::uint8_t>(std::find(wanted.begin(), wanted.end(), label) != wanted.end());
  });
  return mask;
}

Mask mask_of(const LabelMap& labels) {
  Mask mask{labels.geometry, std::vector<std::uint8_t>(labels.voxels.size())};
  std::transform(labels.voxels.begin(), labels.voxels.end(), mask.voxels.begin(),
                 [](std::uint16_t label) { return static_cast<std::uint8_t>(label != 0); });
  return mask;
}

std::size_t count(const Mask& mask) {
  return std::accumulate(mask.voxels.begin(), mask.voxels.end(), std::size_t{0});
}

double volume(const Mask& mask) {
  return static_cast<double>(count(mask)) * mask.geometry.voxel_volume();
}

bool touches_border(const Mask& mask) {
  const Box box = bounding_box(mask);
  return count(mask) > 0 && ((box.lower == 0).any() || (box.upper == mask.geometry.size - 1).any());
}

Mask complement(Mask mask) {
  for (std::uint8_t& voxel : mask.voxels) {
    voxel = voxel == 0 ? 1 : 0;
  }
  return mask;
}

Mask cropped(const Mask& mask, const Eigen::Array3i& margin) {
  const Box box = bounding_box(mask);
  const Eigen::Array3i lower = box.lower - margin;
  ImageGeometry part = mask.geometry;
  part.size = box.upper - box.lower + 1 + 2 * margin;
  part.origin = mask.geometry.to_world(lower.cast<double>().matrix());
  return cropped_to(mask, part);
}

Mask cropped_to(const Mask& mask, const ImageGeometry& grid) {
  const Eigen::Array3i lower = shift_between(mask.geometry, grid);
  Mask part{grid, std::vector<std::uint8_t>(grid.voxel_count())};
  for_each_inside(mask, [&](const Eigen::Array3i& voxel) {
    const Eigen::Array3i place = voxel - lower;
    if ((place >= 0).all() && (place < grid.size).all()) {
      part.at(place.x(), place.y(), place.z()) = 1;
    }
  });
  return part;
}

Mask uncropped(const Mask& mask, const ImageGeometry& grid) {
  const Eigen::Array3i shift = shift_between(grid, mask.geometry);
  Mask whole{grid, std::vector<std::uint8_t>(grid.voxel_count())};
  for_each_inside(mask, [&](const Eigen::Array3i& voxel) {
    const Eigen::Array3i place = voxel + shift;
    whole.at(place.x(), place.y(), place.z()) = 1;
  });
  return whole;
}

Mask largest_component(const Mask& mask) {
  const Components found = components(mask);
  const auto largest = std::max_element(found.sizes.begin(), found.sizes.end());
  const auto number = static_cast<std::int32_t>(largest - found.sizes.begin()) + 1;
  Mask result{mask.geometry, std::vector<std::uint8_t>(mask.voxels.size())};
  std::transform(found.number.begin(), found.number.end(), result.voxels.begin(),
                 [number](std::int32_t n) { return static_cast<std::uint8_t>(n == number); });
  return result;
}

Mask holes_filled(const Mask& mask) {
  if (count(mask) == 0) {
    return mask;
  }
  Mask outside = complement(cropped(mask, 1));  // its outermost layer is one component, that of voxel 0
  const Components found = components(outside);
  std::transform(found.number.begin(), found.number.end(), outside.voxels.begin(),
                 [](std::int32_t number) { return static_cast<std::uint8_t>(number != 1); });
  return uncropped(outside, mask.geometry);
}

}  // namespace brainshift
