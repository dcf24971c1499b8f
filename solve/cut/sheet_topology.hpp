// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "segmentation/geometry/surface.hpp"

namespace brainshift::solve {

/// Throws std::invalid_argument, naming the sheet and the place, where a triangle has no area.
void check_triangles(const Surface& sheet, const std::string& name);

/// The sheet of a cut with its triangles turned to agree with the first. Throws std::invalid_argument, naming the sheet
/// and the place, unless it can be cut along: no triangle without area, at most two at an edge, one piece, two sides,
/// one rim, no vertex at which it touches itself.
Surface oriented_sheet(Surface sheet, const std::string& name);

}  // namespace brainshift::solve
