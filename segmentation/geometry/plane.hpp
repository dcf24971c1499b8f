// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "segmentation/geometry/points.hpp"

namespace brainshift {

/// A planar problem lies in the plane z = 0. A sentence about the first point (row, called `what`) that does not; none
/// when all do.
std::optional<std::string> off_plane(const Points& points, const std::string& what);

}  // namespace brainshift
