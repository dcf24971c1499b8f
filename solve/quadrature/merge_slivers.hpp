// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "solve/quadrature/integration_points.hpp"

namespace brainshift::solve {

/// Which of the points before it was, and whether slivers have moved it.
struct MergedPoint {
  std::int32_t from;
  bool moved;
};

/// Merges each point of less than a tenth of its full volume into the nearest other of its tissue, at their common
/// centroid: linear functions are integrated as before. One that has none of its tissue within about two cells stays.
/// Where a cell is cut to a sliver its point has no weight to hold it, and a large strain turns it inside out. full:
/// volume that a point of the uncut cell has, mm³, one a point. Returns one row a point that is left.
std::vector<MergedPoint> merge_slivers(std::span<const double> full, IntegrationPoints& points);

}  // namespace brainshift::solve
