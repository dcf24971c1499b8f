// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "segmentation/geometry/points.hpp"

namespace brainshift {

/// The points in ascending order, each once: a search for the nearest of many equal points would be one of them all.
inline Points distinct_points(const Points& points) {
  std::vector<std::array<double, 3>> rows;
  rows.reserve(static_cast<std::size_t>(points.rows()));
  for (const auto& point : points.rowwise()) {
    rows.push_back({point[0], point[1], point[2]});
  }
  std::ranges::sort(rows);
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  Points distinct(static_cast<Eigen::Index>(rows.size()), 3);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    distinct.row(static_cast<Eigen::Index>(i)) << rows[i][0], rows[i][1], rows[i][2];
  }
  return distinct;
}

}  // namespace brainshift
