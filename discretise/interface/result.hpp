// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "discretise/interface/background_cells.hpp"
#include "discretise/interface/node_cloud.hpp"

namespace brainshift::discretise {

struct DiscretiseMeasures {
  std::size_t nodes = 0;
  std::size_t surface_nodes = 0;
  std::size_t wall_nodes = 0;      ///< on the wall of what a resection will take out
  std::size_t boundary_nodes = 0;  ///< moved onto a boundary between tissues
  std::size_t removed_nodes = 0;   ///< left out because they were too near to another
  std::size_t cells = 0;
  std::size_t cut_cells = 0;
  std::size_t dropped_cells = 0;       ///< left out: cut hexahedra with a negligible inside part, flat tetrahedra
  double dropped_volume = 0;           ///< of those, mm³
  double spacing = 0;                  ///< the uniform spacing used, mm
  double mean_spacing = 0;             ///< the mean over the nodes of the one achieved, mm
  double smallest_distance_ratio = 0;  ///< least over nodes of distance to the nearest node / local spacing
  double surface_volume = 0;           ///< mm³
  double cells_inside_volume = 0;      ///< mm³
};

struct Discretisation {
  NodeCloud cloud;
  BackgroundCells cells;
  DiscretiseMeasures measures;
};

}  // namespace brainshift::discretise
