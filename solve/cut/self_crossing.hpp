// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "segmentation/geometry/surface.hpp"

namespace brainshift::solve {

/// Two segments of a path x, y that cross, touch or lie on each other in more than the vertex between neighbours, each
/// by its first vertex; none when there are no such. Exact. No vertex may repeat the one before.
std::optional<std::pair<std::size_t, std::size_t>> meeting_segments(
    const std::vector<std::pair<double, double>>& vertices);

/// Two triangles of a sheet that cross, touch or lie on each other in more than the edge or vertex that they share;
/// none when there are no such. Exact. The sheet must be 2-manifold, its triangles oriented alike.
std::optional<std::pair<std::size_t, std::size_t>> meeting_triangles(const Surface& sheet);

}  // namespace brainshift::solve
