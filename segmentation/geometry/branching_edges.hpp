// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "segmentation/geometry/surface.hpp"

namespace brainshift {

/// How many triangles each edge has; edges by their vertices, the lower first.
inline std::map<std::array<std::int32_t, 2>, int> triangles_at_edges(const Triangles& triangles) {
  std::map<std::array<std::int32_t, 2>, int> count;
  for (const auto& f : triangles.rowwise()) {
    for (int i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax({f[i], f[(i + 1) % 3]});
      ++count[{low, high}];
    }
  }
  return count;
}

/// Edges at which more than two triangles meet.
inline std::vector<std::array<std::int32_t, 2>> branching_edges(const Triangles& triangles) {
  std::vector<std::array<std::int32_t, 2>> branching;
  for (const auto& [edge, times] : triangles_at_edges(triangles)) {
    if (times > 2) {
      branching.push_back(edge);
    }
  }
  return branching;
}

}  // namespace brainshift
