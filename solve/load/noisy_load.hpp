// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "discretise/interface/node_cloud.hpp"
#include "solve/interface/conditions.hpp"
#include "solve/load/craniotomy_load.hpp"

namespace brainshift::solve {

/// Deeper than this below the plane of the nearest surface nodes a measured point is one inside the brain, mm; else it
/// is one of the cortex.
inline constexpr double cortex_depth = 5.0;

/// Rows of the measured points that lie inside the brain, ascending.
std::vector<Eigen::Index> inner_points(const NodeCloud& cloud, const CraniotomyLoad& load);

/// The conditions of a load with standard deviations. Points of the cortex are extended to the surface nodes under the
/// opening, prescribed_on_surface_nodes(), with the share of each in each node; points inside are kept apart. Throws as
/// that does; std::invalid_argument on a point without a standard deviation.
Conditions noisy_conditions(const NodeCloud& cloud, const CraniotomyLoad& load, const OpeningOptions& options = {});

/// The conditions of displacements that are known at nodes (n × 3, mm; NaN: free) with the same standard deviation
/// along each axis, mm, as of a field of another program, whose faults are alike at neighbours: at most
/// most_measured_points of the nodes count as measured, and each other one shares the faults of the four nearest of
/// these, by the inverse squares of their distances. Throws std::invalid_argument where no node has a displacement, or
/// the standard deviation is too small.
Conditions noisy_field(const NodeCloud& cloud, const Points& displacement, double sigma);

}  // namespace brainshift::solve
