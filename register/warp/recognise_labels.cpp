// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/warp/recognise_labels.hpp"

#include <cmath>
#include <unordered_set>

namespace brainshift::registration {

namespace {

/// Of the pairs of voxels beside each other along x that are not both background, the share that is equal.
double share_of_equal_neighbours(const ScalarImage& image) {
  const Eigen::Array3i& size = image.geometry.size;
  std::size_t pairs = 0, equal = 0;
  for (int k = 0; k < size.z(); ++k) {
    for (int j = 0; j < size.y(); ++j) {
      for (int i = 0; i + 1 < size.x(); ++i) {
        const float a = image.at(i, j, k), b = image.at(i + 1, j, k);
        pairs += a != 0 || b != 0 ? 1 : 0;
        equal += a != 0 && a == b ? 1 : 0;
      }
    }
  }
  return pairs == 0 ? 1 : static_cast<double>(equal) / static_cast<double>(pairs);
}

}  // namespace

bool looks_like_labels(const ScalarImage& image) {
  constexpr std::size_t most_labels = 512;  // atlases have up to some 200
  constexpr std::size_t of_a_mask = 8;      // electrodes and vessels may be a voxel thick
  std::unordered_set<float> values;
  float last = 0;
  for (const float value : image.voxels) {
    if (value == last && !values.empty()) {
      continue;
    }
    last = value;
    if (value != std::floor(value) || (values.insert(value), values.size() > most_labels)) {
      return false;
    }
  }
  constexpr double mostly = 0.5;
  return values.size() <= of_a_mask || share_of_equal_neighbours(image) > mostly;
}

}  // namespace brainshift::registration
