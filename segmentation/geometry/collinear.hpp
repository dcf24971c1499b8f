// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/geometry/points.hpp"

namespace brainshift {

/// Whether points lie along one line, to a fiftieth of their extent: a turn about it would hardly move any of them.
bool are_in_line(const Points& points);

}  // namespace brainshift
