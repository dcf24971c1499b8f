// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/discretise.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <stdexcept>

#include "discretise/body/check_surface.hpp"
#include "discretise/cells/hexahedra.hpp"
#include "discretise/cells/tetrahedra.hpp"
#include "discretise/cloud/boundary_nodes.hpp"
#include "discretise/cloud/interior_nodes.hpp"
#include "discretise/cloud/make_cloud.hpp"
#include "discretise/cloud/node_demand.hpp"
#include "discretise/interface/option_table.hpp"
#include "segmentation/geometry/finer.hpp"

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

bool is_resected(const DiscretiseOptions& options, std::int32_t label) {
  return std::ranges::find(options.resected->labels, label) != options.resected->labels.end();
}

/// The part of the wall in the body, turned over.
std::optional<InnerWall> inner_wall(const DiscretiseOptions& options, const Scanlines& body,
                                    const std::shared_ptr<const Scanlines>& resected) {
  if (!resected) {
    return std::nullopt;
  }
  constexpr double pieces = 100;  // of the wall's extent: whether one lies in the body its corners tell
  const Surface whole = finer(options.resected->wall, extent(options.resected->wall) / pieces);
  InnerWall wall{.surface = {whole.vertices, Triangles(whole.triangles.rows(), 3)},
                 .beyond = Scanlines(body, resected, false)};
  Eigen::Index kept = 0;
  for (const auto& corners : whole.triangles.rowwise()) {
    const auto inside = [&](std::int32_t vertex) { return body.inside(whole.vertices.row(vertex).transpose()); };
    if (inside(corners[0]) || inside(corners[1]) || inside(corners[2])) {
      wall.surface.triangles.row(kept++) << corners[0], corners[2], corners[1];
    }
  }
  if (kept == 0) {
    throw std::invalid_argument(
        "the wall of what the resection takes out does not meet the brain; are both of one head and one frame?");
  }
  wall.surface.triangles.conservativeResize(kept, 3);
  return wall;
}

/// What the resection leaves, then what it takes.
std::vector<BodySide> sides_of(const Scanlines& body, const std::shared_ptr<const Scanlines>& resected,
                               const TissueLookup& tissue, const LabelMap* labels, const DiscretiseOptions& options) {
  if (!resected) {
    return {{body, tissue}};
  }
  std::vector<std::int32_t> left, taken;
  for (const std::int32_t label : options.brain_labels) {
    (is_resected(options, label) ? taken : left).push_back(label);
  }
  return {{Scanlines(body, resected, false), TissueLookup(labels, left)},
          {Scanlines(body, resected, true), TissueLookup(labels, taken)}};
}

CellGrid make_cells(std::span<const Surface> surfaces, const Scanlines& body, std::span<const BodySide> sides,
                    const NodeDemand& demand, const DiscretiseOptions& options, const NodeCloud& cloud) {
  if (options.cells == CellKind::tetrahedron) {
    return inside_tetrahedra(cloud.positions, body, sides);
  }
  const double cells = options.cells_per_node * static_cast<double>(cloud.size());
  const double edge = std::cbrt(volume_demand(surfaces.front(), body, demand.sizing) / cells);
  return cut_hexahedra(surfaces, sides, demand.sizing, edge);
}

}  // namespace

Discretisation discretise(const Surface& brain, const LabelMap* labels, const DiscretiseOptions& options,
                          const Progress& progress) {
  check_options(options);
  report(progress, 0.0, "checking the surface");
  check_encloses_body(brain);
  std::vector<Surface> surfaces{brain};
  const Scanlines body(brain);
  std::shared_ptr<const Scanlines> resected;
  if (options.resected) {
    check_encloses_body(options.resected->wall, "the wall of what the resection takes out");
    surfaces.push_back(options.resected->wall);
    resected = std::make_shared<const Scanlines>(options.resected->wall);
  }
  const std::optional<InnerWall> wall = inner_wall(options, body, resected);
  const TissueLookup tissue(labels, options.brain_labels);
  report(progress, 0.1, "sizing field");
  const NodeDemand demand = node_demand(brain, wall ? wall->surface : Surface(), body, labels, options);

  Discretisation result;
  const Points boundary = smooth_tissue_boundary(labels, options);
  const MadeCloud made = make_cloud(brain, body, wall ? &*wall : nullptr, boundary, demand, options, progress);
  result.cloud = made.cloud;
  check_labels_overlap(result.cloud, tissue);
  report(progress, 0.8, "background cells");
  const std::vector<BodySide> sides = sides_of(body, resected, tissue, labels, options);
  CellGrid grid = make_cells(surfaces, body, sides, demand, options, result.cloud);
  result.cells = std::move(grid.cells);

  DiscretiseMeasures& measures = result.measures;
  const NodeCloud& cloud = result.cloud;
  measures.nodes = cloud.size();
  measures.surface_nodes = std::accumulate(cloud.on_surface.begin(), cloud.on_surface.end(), std::size_t{0});
  measures.wall_nodes = made.wall_nodes;
  measures.boundary_nodes = made.boundary_nodes;
  measures.removed_nodes = made.removed_nodes;
  measures.cells = result.cells.size();
  measures.cut_cells = result.cells.cut_parts.size();
  measures.dropped_cells = grid.dropped_cells;
  measures.dropped_volume = grid.dropped_volume;
  measures.spacing = demand.spacing;
  measures.mean_spacing = mean_spacing(cloud);
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
