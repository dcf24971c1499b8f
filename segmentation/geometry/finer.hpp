// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "segmentation/geometry/surface.hpp"

namespace brainshift {

/// The longest edge of a surface's triangles, mm; 0 without any.
inline double longest_edge(const Surface& surface) {
  double longest = 0;
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    const Triangle corners = triangle(surface, t);
    longest = std::max(
        {longest, (corners.b - corners.a).norm(), (corners.c - corners.b).norm(), (corners.a - corners.c).norm()});
  }
  return longest;
}

/// The same surface with each triangle split in four, as often as it takes until no edge is longer than that, mm.
inline Surface finer(Surface surface, double longest) {
  while (longest_edge(surface) > longest) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
    const Points before = surface.vertices;
    auto count = static_cast<std::int32_t>(before.rows());
    const auto middle = [&](std::int32_t a, std::int32_t b) {
      const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), count);
      count += is_new ? 1 : 0;
      return place->second;
    };
    Triangles split(4 * surface.triangles.rows(), 3);
    for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
      const std::int32_t a = surface.triangles(t, 0), b = surface.triangles(t, 1), c = surface.triangles(t, 2);
      const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      split.middleRows<4>(4 * t) << a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca;
    }
    surface.vertices.conservativeResize(count, 3);
    for (const auto& [edge, vertex] : middles) {
      surface.vertices.row(vertex) = (before.row(edge.first) + before.row(edge.second)) / 2;
    }
    surface.triangles = std::move(split);
  }
  return surface;
}

}  // namespace brainshift
