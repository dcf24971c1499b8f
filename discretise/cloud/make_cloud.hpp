// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "discretise/body/scanlines.hpp"
#include "discretise/cloud/node_demand.hpp"
#include "discretise/interface/node_cloud.hpp"
#include "segmentation/progress/progress.hpp"

namespace brainshift::discretise {

/// A cloud, and how it came out.
struct MadeCloud {
  NodeCloud cloud;
  double smallest_distance_ratio = 0;  ///< least over nodes of distance to the nearest node / local spacing
  std::size_t removed_nodes = 0;       ///< left out because they were too near to another
};

/// Spreads the nodes over the surface and in the body, takes out those nearer than options.minimum_distance, orders
/// them along a Hilbert curve and measures the spacing.
MadeCloud make_cloud(const Surface& surface, const Scanlines& body, const NodeDemand& demand,
                     const DiscretiseOptions& options, const Progress& progress);

}  // namespace brainshift::discretise
