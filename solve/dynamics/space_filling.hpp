// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "segmentation/surface/surface.hpp"

namespace brainshift::solve {

/// The order of points (n × 3) along a Morton curve over their bounding box: neighbours in space come near in memory.
std::vector<std::int32_t> space_filling_order(const Points& points);

}  // namespace brainshift::solve
