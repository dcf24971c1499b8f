// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "discretise/interface/node_cloud.hpp"
#include "segmentation/geometry/points.hpp"
#include "solve/load/craniotomy_load.hpp"

namespace brainshift::solve {

/// Throws std::invalid_argument where nothing is measured, or not one displacement at each position; with the point
/// where a number is not finite.
void check_load(const CraniotomyLoad& load);

/// Throws std::invalid_argument, with the distance and the point, when a measured point lies farther from every node of
/// the surface than is allowed (mm); and when the points lie off the surface as they are and on it with x and y turned:
/// RAS was then taken for LPS, or LPS for RAS. rows, all: of the points in a load of so many; all 0: these are all.
void check_near_surface(const Points& measured, const Points& surface, double farthest_allowed,
                        std::span<const Eigen::Index> rows = {}, Eigen::Index all = 0);

/// The same of points that may lie inside the brain: throws std::invalid_argument when they lie three times as far off
/// the surface, in the median, as with x and y turned, and all of these within the allowed distance (mm); and when
/// three or more of them lie within a millimetre, as in metres.
void check_frame(const Points& measured, const Points& surface, double farthest_allowed);

/// Share of the measured points that are not taken: no prescribed node is nearer to them than the nearest node of the
/// surface and two of its spacings. prescribed: (n × 3) mm, NaN: free.
double share_not_taken(const Points& measured, const NodeCloud& cloud, const Points& prescribed);

/// Throws std::invalid_argument when more than half of them are not taken: they do not lie about one opening.
void check_taken(const Points& measured, const NodeCloud& cloud, const Points& prescribed);

/// Throws std::invalid_argument, with the point, when one moves by more than half of the body: a brain sinks or swells
/// by a part of itself; what moves farther is in another unit, or is a place and no movement.
void check_moved(const Points& displacement, const Points& surface);

/// Throws std::invalid_argument where each displacement is about the place that it is of: these are then where the
/// points went.
void check_no_places(const CraniotomyLoad& load);

}  // namespace brainshift::solve
