// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "segmentation/image/image.hpp"
#include "solve/interface/solution.hpp"

namespace brainshift::registration {

/// The solution's estimated error, mm, at points (n × 3, mm, LPS) of the preop or, with `moved`, the intraop brain:
/// weights 1 / distance² over the eight nearest nodes. 0 at a point farther than the spacing from every node. The
/// solution must have an estimate.
std::vector<double> estimated_error_at(const Solution& solution, bool moved, const Points& points);

/// The same as an image around the nodes, voxels of 4 mm along the axes of LPS.
ScalarImage estimated_error_image(const Solution& solution, bool moved);

}  // namespace brainshift::registration
