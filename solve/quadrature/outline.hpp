// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "discretise/interface/background_cells.hpp"
#include "discretise/interface/node_cloud.hpp"

namespace brainshift::solve {

/// The polygons through the surface nodes of a cloud in the plane z = 0, two nodes each edge: what bounds the body
/// where its cells do not say. Empty where they cannot be told: an edge is missing, or what they enclose has not the
/// area of the cells.
std::vector<std::array<std::int32_t, 2>> outline(const NodeCloud& cloud, const BackgroundCells& cells);

/// Whether x lies within closed polygons: an odd number of edges to one side of it.
bool is_within(const Points& positions, const std::vector<std::array<std::int32_t, 2>>& edges,
               const Eigen::Vector3d& x);

}  // namespace brainshift::solve
