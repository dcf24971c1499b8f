// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/moving_part.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace brainshift::registration {

namespace {

/// Voxels low to high, both included.
struct IndexBox {
  Eigen::Array3i low, high;
};

IndexBox box_of_moving(const VectorImage& field) {
  const ImageGeometry& g = field.geometry;
  IndexBox box{g.size - 1, Eigen::Array3i::Zero()};
  for (int k = 0; k < g.size.z(); ++k) {
    for (int j = 0; j < g.size.y(); ++j) {
      const std::span row(&field.at(0, j, k), static_cast<std::size_t>(g.size.x()));
      const auto moves = [](const std::array<float, 3>& u) { return u != std::array<float, 3>{0, 0, 0}; };
      const auto first = std::find_if(row.begin(), row.end(), moves);
      if (first != row.end()) {
        const auto past = std::find_if(row.rbegin(), row.rend(), moves).base();
        box.low = box.low.min(Eigen::Array3i(static_cast<int>(first - row.begin()), j, k));
        box.high = box.high.max(Eigen::Array3i(static_cast<int>(past - row.begin()) - 1, j, k));
      }
    }
  }
  box.low = (box.low.min(box.high) - 1).max(0);
  box.high = (box.high + 1).min(g.size - 1);
  return box;
}

VectorImage cut(const VectorImage& field, const IndexBox& box) {
  VectorImage part{field.geometry, {}};
  part.geometry.size = box.high - box.low + 1;
  part.geometry.origin = field.geometry.to_world(box.low.cast<double>().matrix());
  part.voxels.reserve(part.geometry.voxel_count());
  for (int k = box.low.z(); k <= box.high.z(); ++k) {
    for (int j = box.low.y(); j <= box.high.y(); ++j) {
      const auto row = field.voxels.begin() + static_cast<std::ptrdiff_t>(field.geometry.offset(box.low.x(), j, k));
      part.voxels.insert(part.voxels.end(), row, row + part.geometry.size.x());
    }
  }
  return part;
}

}  // namespace

VectorImage moving_part(const VectorImage& field) {
  return cut(field, box_of_moving(field));
}

}  // namespace brainshift::registration
