// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/loose_vertices.hpp"

#include <vector>

namespace brainshift {

Surface without_loose_vertices(const Surface& surface) {
  std::vector<std::int32_t> place(static_cast<std::size_t>(surface.vertices.rows()), -1);
  for (const std::int32_t v : surface.triangles.reshaped()) {
    place[static_cast<std::size_t>(v)] = 0;
  }
  std::vector<Eigen::Index> used;
  for (std::size_t v = 0; v < place.size(); ++v) {
    if (place[v] == 0) {
      place[v] = static_cast<std::int32_t>(used.size());
      used.push_back(static_cast<Eigen::Index>(v));
    }
  }
  return {surface.vertices(used, Eigen::all),
          surface.triangles.unaryExpr([&](std::int32_t v) { return place[static_cast<std::size_t>(v)]; })};
}

}  // namespace brainshift
