// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "segmentation/geometry/points.hpp"

namespace brainshift {

/// The nearest other points of each point, nearest first.
struct NearestNeighbours {
  int count = 0;                    ///< neighbours a point: as asked, or fewer when there are not that many points
  std::vector<std::int32_t> index;  ///< (points × count)
  std::vector<double> distance;     ///< (points × count), mm
};

/// Uses all threads; the result does not depend on their number.
NearestNeighbours nearest_neighbours(const Points& points, int count);

/// The mean distance of each point to its `count` nearest, mm: what a cloud without a stated spacing has for one.
std::vector<double> mean_neighbour_distance(const NearestNeighbours& neighbours, int count = 6);

}  // namespace brainshift
