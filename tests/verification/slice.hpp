// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "discretise/interface/background_cells.hpp"
#include "discretise/interface/node_cloud.hpp"
#include "segmentation/geometry/surface.hpp"

namespace brainshift::verification {

/// Where a plane cuts a surface: the longest closed line, counter-clockwise, in the plane's own coordinates (n × 3 with
/// z = 0, mm). Its axes are `right`, and `up` made perpendicular to it. Throws std::runtime_error when there is none.
Points section(const Surface& surface, const Eigen::Vector3d& origin, const Eigen::Vector3d& right,
               const Eigen::Vector3d& up);

/// Irregular nodes in a closed line and on it, no nearer to each other than the least distance.
NodeCloud cloud_in(const Points& outline, double least_distance, unsigned seed);

/// The Delaunay triangles of the nodes that lie inside the closed line: background cells whose corners are the nodes.
BackgroundCells triangles_in(const Points& outline, const Points& nodes);

}  // namespace brainshift::verification
