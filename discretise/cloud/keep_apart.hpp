// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "segmentation/geometry/points.hpp"

namespace brainshift::discretise {

/// The distances that a cloud has.
struct CloudDistances {
  std::vector<double> spacing;  ///< a node: mean distance to its six nearest, evened out over those, mm
  std::vector<double> nearest;  ///< to the nearest node, mm
};

CloudDistances cloud_distances(const Points& nodes);

/// Which nodes to leave out so that none is nearer to another than `fraction` of its spacing: of two such the one in
/// the interior, else the later. The first `on_surface` rows lie on the surface, a wall or a boundary. Returns one flag
/// a node, 1: keep.
std::vector<char> keep_apart(const Points& nodes, std::size_t on_surface, double fraction);

}  // namespace brainshift::discretise
