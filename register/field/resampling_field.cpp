// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/resampling_field.hpp"

#include <array>
#include <vector>

#include "register/field/field_sampler.hpp"
#include "register/field/invert_at.hpp"

namespace brainshift::registration {

InvertedField resampling_field(const VectorImage& forward, double tolerance) {
  const ImageGeometry& g = forward.geometry;
  const FieldGrid grid = FieldSampler(forward).grid();
  InvertedField result{{g, std::vector<std::array<float, 3>>(g.voxel_count(), std::array<float, 3>{0, 0, 0})}, 0};
  const auto store = [&](std::size_t offset, const std::array<float, 3>& d) { result.field.voxels[offset] = d; };
  std::size_t missed = 0;
#pragma omp parallel for schedule(dynamic, 1) reduction(+ : missed)
  for (int k = 0; k < g.size.z(); ++k) {
    for (int j = 0; j < g.size.y(); ++j) {
      missed += invert_row(grid, j, k, tolerance, store);
    }
  }
  result.not_inverted = missed;
  return result;
}

}  // namespace brainshift::registration
