// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "segmentation/geometry/surface.hpp"

namespace brainshift {

/// Of each point the first that lies at the same place, to the last bit: triangles and cells whose corners are not
/// shared, as many programs write them, hang together by these.
inline std::vector<std::int32_t> first_at_same_place(const Points& points) {
  std::map<std::array<double, 3>, std::int32_t> first;
  std::vector<std::int32_t> of_each;
  of_each.reserve(static_cast<std::size_t>(points.rows()));
  for (const auto& x : points.rowwise()) {
    of_each.push_back(first.try_emplace({x[0], x[1], x[2]}, static_cast<std::int32_t>(of_each.size())).first->second);
  }
  return of_each;
}

/// Makes triangles of such vertices hang together.
inline void join_at_same_places(const Points& vertices, Triangles& triangles) {
  const std::vector<std::int32_t> first = first_at_same_place(vertices);
  for (std::int32_t& corner : triangles.reshaped()) {
    corner = first[static_cast<std::size_t>(corner)];
  }
}

}  // namespace brainshift
