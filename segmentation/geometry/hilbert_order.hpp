// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "segmentation/geometry/points.hpp"

namespace brainshift {

/// The order of points (n × 3) along a Hilbert curve (CGAL's, through medians): neighbours in space are near in memory.
std::vector<std::int32_t> hilbert_order(const Points& points);

}  // namespace brainshift
