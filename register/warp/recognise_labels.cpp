// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/warp/recognise_labels.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace brainshift::registration {

namespace {

/// Of the pairs of voxels beside each other along x that are not both background, the share that is equal.
double share_of_equal_neighbours(const ScalarImage& image, float background) {
  const Eigen::Array3i& size = image.geometry.size;
  std::size_t pairs = 0, equal = 0;
  for (int k = 0; k < size.z(); ++k) {
    for (int j = 0; j < size.y(); ++j) {
      for (int i = 0; i + 1 < size.x(); ++i) {
        const float a = image.at(i, j, k), b = image.at(i + 1, j, k);
        pairs += a != background || b != background ? 1 : 0;
        equal += a != background && a == b ? 1 : 0;
      }
    }
  }
  return pairs == 0 ? 1 : static_cast<double>(equal) / static_cast<double>(pairs);
}

/// How often each value comes; empty where one is no label, or there are too many.
std::unordered_map<float, std::size_t> count_labels(const ScalarImage& image) {
  constexpr std::size_t most_labels = 4096;  // atlases have up to some 1000
  std::unordered_map<float, std::size_t> counts;
  for (const float value : image.voxels) {
    constexpr float outside = -1;  // as some maps have it
    if (!(value >= outside) || value != std::floor(value) || (++counts[value], counts.size() > most_labels)) {
      return {};
    }
  }
  return counts;
}

}  // namespace

bool looks_like_labels(const ScalarImage& image) {
  constexpr std::size_t of_a_mask = 8;  // electrodes and vessels may be a voxel thick
  constexpr double mostly = 0.5;
  const auto counts = count_labels(image);
  if (counts.size() <= of_a_mask) {
    return !counts.empty();
  }
  const auto rarer = [](const auto& a, const auto& b) { return a.second < b.second; };
  const float background = std::max_element(counts.begin(), counts.end(), rarer)->first;
  return share_of_equal_neighbours(image, background) > mostly;
}

}  // namespace brainshift::registration
