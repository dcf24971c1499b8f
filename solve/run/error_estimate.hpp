// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "discretise/interface/node_cloud.hpp"

namespace brainshift::solve {

/// What the displacement may be wrong by at each node for want of nodes, mm: the share of its distance from the coarse
/// solution that the finer spacing leaves, root mean square over the nodes within two spacings, as two fields may
/// cross. displacement, coarse: at all nodes (n × 3), mm; wider: spacing of the coarse nodes over that of the cloud. It
/// knows nothing of loads, materials or images that are wrong.
std::vector<double> estimated_error(const NodeCloud& cloud, const Points& displacement, const Points& coarse,
                                    double wider);

/// Below which 95 % of the values lie.
double percentile_95(std::vector<double> values);

}  // namespace brainshift::solve
