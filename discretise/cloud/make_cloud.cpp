// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cloud/make_cloud.hpp"

#include <algorithm>
#include <limits>

#include "discretise/cloud/boundary_nodes.hpp"
#include "discretise/cloud/delaunay.hpp"
#include "discretise/cloud/interior_nodes.hpp"
#include "discretise/cloud/keep_apart.hpp"
#include "discretise/cloud/surface_nodes.hpp"
#include "segmentation/geometry/hilbert_order.hpp"

namespace brainshift::discretise {
namespace {

/// How many of the first rows of nodes lie where.
struct Rows {
  std::size_t on_surface;
  std::size_t on_wall;      ///< those next
  std::size_t on_boundary;  ///< those after them
  std::size_t kept_first() const { return on_surface + on_wall + on_boundary; }
};

/// Rows of nodes with those too near to another taken out. Taking one out changes the spacing around it, hence the
/// rounds.
void thin_out(Points& nodes, Rows& rows, double fraction) {
  for (int round = 0; round < 20; ++round) {
    const std::vector<char> keep = keep_apart(nodes, rows.kept_first(), fraction);
    Eigen::Index kept = 0;
    Rows rows_kept{0, 0, 0};
    for (std::size_t node = 0; node < keep.size(); ++node) {
      if (keep[node] != 0) {
        if (node < rows.on_surface) {
          ++rows_kept.on_surface;
        } else if (node < rows.on_surface + rows.on_wall) {
          ++rows_kept.on_wall;
        } else if (node < rows.kept_first()) {
          ++rows_kept.on_boundary;
        }
        nodes.row(kept++) = nodes.row(static_cast<Eigen::Index>(node));
      }
    }
    if (kept == nodes.rows()) {
      return;
    }
    nodes.conservativeResize(kept, 3);
    rows = rows_kept;
  }
}

NodeCloud describe(const Points& nodes, std::size_t on_surface) {
  const std::vector<std::int32_t> order = hilbert_order(nodes);
  NodeCloud cloud;
  cloud.positions.resize(nodes.rows(), 3);
  cloud.on_surface.resize(order.size());
#pragma omp parallel for schedule(static)
  for (std::size_t node = 0; node < order.size(); ++node) {
    const auto row = static_cast<Eigen::Index>(node);
    cloud.positions.row(row) = nodes.row(order[node]);
    cloud.on_surface[node] = static_cast<std::size_t>(order[node]) < on_surface ? 1 : 0;
  }
  return cloud;
}

}  // namespace

MadeCloud make_cloud(const Surface& surface, const Scanlines& body, const InnerWall* wall, const Points& boundary,
                     const NodeDemand& demand, const DiscretiseOptions& options, const Progress& progress) {
  Random random(options.seed);
  report(progress, 0.15, "nodes on the surface");
  const Points rim = options.craniotomy ? options.craniotomy->rim : Points(0, 3);
  const Points on_surface =
      spread_over_surface(surface, body, demand.sizing, demand.spacing, demand.surface_nodes, rim, random);
  Points fixed = on_surface;
  if (wall != nullptr) {
    const Points on_wall = spread_over_surface(wall->surface, wall->beyond, demand.sizing, demand.spacing,
                                               demand.wall_nodes, Points(0, 3), random);
    fixed.resize(on_surface.rows() + on_wall.rows(), 3);
    fixed << on_surface, on_wall;
  }
  report(progress, 0.4, "nodes in the interior");
  Points interior = fill_interior(fixed, body, demand.sizing, demand.spacing, demand.interior_nodes, random);
  const Eigen::Index before = fixed.rows() + interior.rows();
  const std::size_t on_boundary = move_onto_boundary(boundary, fixed, body, demand.sizing, demand.spacing, interior);
  Points nodes(fixed.rows() + interior.rows(), 3);
  nodes << fixed, interior;

  MadeCloud made;
  Rows rows{static_cast<std::size_t>(on_surface.rows()), static_cast<std::size_t>(fixed.rows() - on_surface.rows()),
            on_boundary};
  thin_out(nodes, rows, options.minimum_distance);
  made.removed_nodes = static_cast<std::size_t>(before - nodes.rows());
  made.wall_nodes = rows.on_wall;
  made.boundary_nodes = rows.on_boundary;
  made.cloud = describe(nodes, rows.on_surface);
  const CloudDistances distances = cloud_distances(made.cloud.positions);
  made.cloud.spacing = distances.spacing;
  made.smallest_distance_ratio = std::numeric_limits<double>::infinity();
  for (std::size_t node = 0; node < made.cloud.size(); ++node) {
    made.smallest_distance_ratio =
        std::min(made.smallest_distance_ratio, distances.nearest[node] / distances.spacing[node]);
  }
  return made;
}

}  // namespace brainshift::discretise
