// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/warp/from_outside.hpp"

#include "register/field/field_sampler.hpp"

namespace brainshift::registration {

double share_from_outside(const ImageGeometry& image, const VectorImage& resampling, const ImageGeometry& grid) {
  constexpr std::size_t most_looks = 1000000;
  constexpr double moves = 0.1;  // mm
  const FieldSampler field(resampling);
  const std::size_t stride = 1 + grid.voxel_count() / most_looks;
  const auto nx = static_cast<std::size_t>(grid.size.x()), ny = static_cast<std::size_t>(grid.size.y());
  std::size_t moved = 0, outside = 0;
  for (std::size_t v = 0; v < grid.voxel_count(); v += stride) {
    const Eigen::Vector3d place = grid.to_world(
        {static_cast<double>(v % nx), static_cast<double>(v / nx % ny), static_cast<double>(v / nx / ny)});
    const Eigen::Vector3d index = field.to_index(place);
    if (!field.inside(index)) {
      continue;
    }
    if (const Eigen::Vector3d u = field.value(index); u.norm() > moves) {
      const Eigen::Array3d from = image.to_index(place + u).array();
      ++moved;
      outside += (from < -0.5).any() || (from > image.size.cast<double>() - 0.5).any() ? 1 : 0;
    }
  }
  return static_cast<double>(outside) / static_cast<double>(moved);
}

}  // namespace brainshift::registration
