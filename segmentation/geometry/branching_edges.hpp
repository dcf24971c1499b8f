// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "segmentation/geometry/surface.hpp"

namespace brainshift {

/// Edges, by their vertices, the lower first, at which more than two triangles meet.
inline std::vector<std::array<std::int32_t, 2>> branching_edges(const Triangles& triangles) {
  std::map<std::array<std::int32_t, 2>, int> count;
  for (const auto& f : triangles.rowwise()) {
    for (int i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax({f[i], f[(i + 1) % 3]});
      ++count[{low, high}];
    }
  }
  std::vector<std::array<std::int32_t, 2>> branching;
  for (const auto& [edge, times] : count) {
    if (times > 2) {
      branching.push_back(edge);
    }
  }
  return branching;
}

}  // namespace brainshift
