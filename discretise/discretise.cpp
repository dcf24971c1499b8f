// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/discretise.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "discretise/body/check_surface.hpp"
#include "discretise/cells/hexahedra.hpp"
#include "discretise/cells/tetrahedra.hpp"
#include "discretise/cloud/interior_nodes.hpp"
#include "discretise/cloud/make_cloud.hpp"
#include "discretise/cloud/node_demand.hpp"
#include "discretise/interface/option_table.hpp"

namespace brainshift::discretise {
namespace {

/// Labels in another frame than the surface would silently give every node the tissue of the nearest rim.
void check_labels_overlap(const NodeCloud& cloud, const TissueLookup& tissue) {
  for (const auto& node : cloud.positions.rowwise()) {
    if (tissue.in_brain(node.transpose())) {
      return;
    }
  }
  throw std::invalid_argument(
      "no node of the cloud lies in a brain voxel of the label map; surface and labels are in "
      "different frames, or the labels of the brain's tissues are wrong.");
}

CellGrid make_cells(const Surface& surface, const Scanlines& body, const NodeDemand& demand, const TissueLookup& tissue,
                    const DiscretiseOptions& options, const NodeCloud& cloud) {
  if (options.cells == CellKind::tetrahedron) {
    return inside_tetrahedra(cloud.positions, body, tissue);
  }
  const double cells = options.cells_per_node * static_cast<double>(cloud.size());
  const double edge = std::cbrt(volume_demand(surface, body, demand.sizing) / cells);
  return cut_hexahedra(surface, body, demand.sizing, tissue, edge);
}

}  // namespace

Discretisation discretise(const Surface& brain, const LabelMap* labels, const DiscretiseOptions& options,
                          const Progress& progress) {
  check_options(options);
  report(progress, 0.0, "checking the surface");
  check_encloses_body(brain);
  const Scanlines body(brain);
  const TissueLookup tissue(labels, options.brain_labels);
  report(progress, 0.1, "sizing field");
  const NodeDemand demand = node_demand(brain, body, labels, options);

  Discretisation result;
  const MadeCloud made = make_cloud(brain, body, demand, options, progress);
  result.cloud = made.cloud;
  check_labels_overlap(result.cloud, tissue);
  report(progress, 0.8, "background cells");
  CellGrid grid = make_cells(brain, body, demand, tissue, options, result.cloud);
  result.cells = std::move(grid.cells);

  DiscretiseMeasures& measures = result.measures;
  const NodeCloud& cloud = result.cloud;
  measures.nodes = cloud.size();
  measures.surface_nodes = std::accumulate(cloud.on_surface.begin(), cloud.on_surface.end(), std::size_t{0});
  measures.removed_nodes = made.removed_nodes;
  measures.cells = result.cells.size();
  measures.cut_cells = result.cells.cut_parts.size();
  measures.dropped_cells = grid.dropped_cells;
  measures.dropped_volume = grid.dropped_volume;
  measures.spacing = demand.spacing;
  measures.mean_spacing =
      std::accumulate(cloud.spacing.begin(), cloud.spacing.end(), 0.0) / static_cast<double>(cloud.size());
  measures.smallest_distance_ratio = made.smallest_distance_ratio;
  measures.surface_volume = volume(brain);
  measures.cells_inside_volume = inside_volume(result.cells);
  report(progress, 1.0, "done");
  return result;
}

void write_discretisation(const std::filesystem::path& folder, const Discretisation& discretisation) {
  write_node_cloud(folder / "nodes.vtu", discretisation.cloud);
  write_background_cells(folder / "cells.vtu", discretisation.cells);
}

}  // namespace brainshift::discretise
