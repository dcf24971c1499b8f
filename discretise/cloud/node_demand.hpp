// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "discretise/body/scanlines.hpp"
#include "discretise/sizing/sizing_field.hpp"

namespace brainshift::discretise {

/// The uniform spacing, the field on it, and how many nodes they take.
struct NodeDemand {
  double spacing = 0;  ///< mm
  SizingField sizing;
  std::size_t surface_nodes = 0;
  std::size_t wall_nodes = 0;
  std::size_t interior_nodes = 0;
};

/// Works out the numbers of nodes for the asked spacing, or the spacing for the asked number of nodes. wall: a surface
/// inside the body that has nodes, too; without triangles: none. Throws std::invalid_argument when the body would hold
/// too few nodes or absurdly many.
NodeDemand node_demand(const Surface& surface, const Surface& wall, const Scanlines& body, const LabelMap* labels,
                       const DiscretiseOptions& options);

}  // namespace brainshift::discretise
