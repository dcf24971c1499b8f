// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "discretise/body/scanlines.hpp"
#include "discretise/cloud/node_demand.hpp"
#include "discretise/interface/node_cloud.hpp"
#include "segmentation/progress/progress.hpp"

namespace brainshift::discretise {

/// The wall of tissue that a resection will take out, inside the body.
struct InnerWall {
  Surface surface;   ///< its normals point into that tissue
  Scanlines beyond;  ///< the body without that tissue
};

/// A cloud, and how it came out.
struct MadeCloud {
  NodeCloud cloud;
  double smallest_distance_ratio = 0;  ///< least over nodes of distance to the nearest node / local spacing
  std::size_t wall_nodes = 0;
  std::size_t boundary_nodes = 0;
  std::size_t removed_nodes = 0;  ///< left out because they were too near to another
};

/// Spreads the nodes over the surface, the wall if there is one, and in the body, moves those near a boundary between
/// tissues onto it (smooth_tissue_boundary()), takes out those nearer than options.minimum_distance, orders them along
/// a Hilbert curve and measures the spacing. Nodes of the wall lie a hair beyond it, outside the tissue that goes; they
/// are not on_surface as long as that tissue is there.
MadeCloud make_cloud(const Surface& surface, const Scanlines& body, const InnerWall* wall, const Points& boundary,
                     const NodeDemand& demand, const DiscretiseOptions& options, const Progress& progress);

}  // namespace brainshift::discretise
