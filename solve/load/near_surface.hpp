// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "segmentation/geometry/points.hpp"

namespace brainshift::solve {

/// Throws std::invalid_argument, with the distance and the point, when a measured point lies farther from every node of
/// the surface than is allowed (mm); and when the points lie off the surface as they are and on it with x and y turned:
/// RAS was then taken for LPS, or LPS for RAS.
void check_near_surface(const Points& measured, const Points& surface, double farthest_allowed);

/// Throws std::invalid_argument, with the point, when one moves by more than half of the body: a brain sinks or swells
/// by a part of itself; what moves farther is in another unit, or is a place and no movement.
void check_moved(const Points& displacement, const Points& surface);

/// One decimal, for sentences.
std::string rounded(double number);

}  // namespace brainshift::solve
