// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "discretise/interface/background_cells.hpp"
#include "segmentation/geometry/surface.hpp"

namespace brainshift::discretise {

/// Finer nodes near a place: within `radius` mm of any of the points the spacing is multiplied by `factor`. Beyond it
/// grows by a quarter of the distance, up to the uniform one.
struct Refinement {
  Points centres;
  double radius = 20.0;
  double factor = 0.5;
  Points rim = Points(0, 3);  ///< places on the surface, dense, where what acts at the centres ends: nodes lie there
};

/// Tissue that a resection will take out.
struct ResectedTissue {
  Surface wall;                           ///< closed, outward from it; it may reach out of the brain, mm
  std::vector<std::int32_t> labels = {};  ///< that it has in the label map
};

/// What each may be stands in option_table.cpp.
struct DiscretiseOptions {
  std::optional<double> spacing = {};  ///< mm; give this or nodes, not both
  /// Wanted number of nodes, met within 5 %; 12,000 when neither is given.
  std::optional<std::size_t> nodes = {};
  double minimum_distance = 0.5;              ///< no node nearer to another than this fraction of its spacing
  std::optional<Refinement> craniotomy = {};  ///< finer towards the opening
  double tumour_factor = 1.0;                 ///< spacing inside and at a tumour / uniform spacing
  std::int32_t tumour_label = 3;
  double tissue_boundary_factor = 1.0;  ///< spacing at boundaries between tissues / uniform spacing
  std::set<std::pair<std::int32_t, std::int32_t>> alike = {};  ///< labels, lower first, between which none counts
  CellKind cells = CellKind::hexahedron;                       ///< or tetrahedron; a body has no planar cells
  /// Hexahedra: cells a node (inside volume / cell volume / nodes). With eight points a cell that is six points a node.
  /// Where the nodes are finer the cells are split.
  double cells_per_node = 0.75;
  std::vector<std::int32_t> brain_labels = {1, 2, 3};  ///< labels of the label map that are tissue of the brain
  std::uint64_t seed = 1;
  std::optional<ResectedTissue> resected = {};  ///< its wall parts the cells and has nodes of its own; absent: none
};

}  // namespace brainshift::discretise
