// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solve/load/extension.hpp"

namespace brainshift::solve {

/// Corners of the convex hull of points in a plane, counter-clockwise, none repeated; two for collinear points, one for
/// a single place (CGAL, exact predicates).
std::vector<Eigen::Vector2d> convex_hull(const PlanePoints& points);

/// The place of a convex polygon with these corners that is nearest to a place: itself inside it.
Eigen::Vector2d nearest_of_hull(const std::vector<Eigen::Vector2d>& hull, const Eigen::Vector2d& place);

}  // namespace brainshift::solve
