// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "segmentation/geometry/points.hpp"

namespace brainshift::solve {

/// At most so many rows of positions (n × 3, n > 0), the first and then each the farthest from those before it; places
/// that are there twice once.
std::vector<Eigen::Index> spread_out(const Points& positions, Eigen::Index most);

}  // namespace brainshift::solve
