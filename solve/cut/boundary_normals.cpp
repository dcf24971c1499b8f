// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/boundary_normals.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "solve/body/ordered_cloud.hpp"
#include "solve/quadrature/cell_boundary.hpp"
#include "solve/quadrature/outline.hpp"

namespace brainshift::solve {

namespace {

/// The facets of a cut in space, or strips along the segments of one in the plane.
Surface surface_of(const CutFacets& cut) {
  if (!cut.planar) {
    return {cut.vertices, cut.facets};
  }
  std::vector<std::array<std::int32_t, 2>> edges;
  for (Eigen::Index s = 0; s < cut.facets.rows(); ++s) {
    edges.push_back({cut.facets(s, 0), cut.facets(s, 1)});
  }
  return strips(cut.vertices, edges);
}

/// Nodes that are held in all directions on a face, not in the corner of planes of symmetry.
std::vector<std::uint8_t> bonded(const OrderedCloud& cloud, std::span<const std::int32_t> surface,
                                 const SurfaceNormals& normals) {
  std::vector<std::uint8_t> result(cloud.size(), 0);
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const auto held = [&](int axis) { return cloud.conditions.is_prescribed(surface[i], axis); };
    result[static_cast<std::size_t>(surface[i])] = normals.rank[i] < 3 && held(0) && held(1) && held(2) ? 1 : 0;
  }
  return result;
}

/// No state is homogeneous beside a bonded face; at its rim, where the state is singular, the normals alone would make
/// it worse by a tenth (measured: verification, cylinder_compression).
void free_beside_bonded(const OrderedCloud& cloud, std::span<const std::int32_t> surface, const ShapeRows& nodal_rows,
                        SurfaceNormals& normals) {
  const std::vector<std::uint8_t> is_bonded = bonded(cloud, surface, normals);
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const std::span<const std::int32_t> support = nodal_rows[static_cast<std::size_t>(surface[i])].node;
    if (std::any_of(support.begin(), support.end(),
                    [&](std::int32_t a) { return is_bonded[static_cast<std::size_t>(a)] != 0; })) {
      normals.rank[i] = 3;
      normals.direction[i].setIdentity();
    }
  }
}

}  // namespace

Surface known_boundary(const Model& model) {
  if (model.resection && !(model.resection->wall && model.boundary)) {
    return {};
  }
  if (model.boundary) {
    return *model.boundary;
  }
  Surface boundary = cell_boundary(model.cells);
  if (boundary.triangles.rows() == 0 && is_planar(model.cells.kind)) {
    boundary = strips(model.cloud.positions, outline(model.cloud, model.cells));
  }
  return boundary;
}

std::optional<SurfaceNormals> boundary_normals(const Surface& boundary, const CutFacets& cut, const OrderedCloud& cloud,
                                               const ShapeRows& nodal_rows) {
  if (boundary.triangles.rows() == 0) {
    return std::nullopt;
  }
  const std::vector<std::int32_t> nodes = surface_nodes(cloud);
  if (nodes.empty()) {
    return std::nullopt;
  }
  std::vector<double> spacing;
  for (const std::int32_t a : nodes) {
    spacing.push_back(cloud.spacing[static_cast<std::size_t>(a)]);
  }
  const Points positions = cloud.positions(nodes, Eigen::all);
  const Surface surfaces[] = {boundary, surface_of(cut)};
  SurfaceNormals normals = surface_normals(surfaces, positions, spacing);
  free_beside_bonded(cloud, nodes, nodal_rows, normals);
  return normals;
}

}  // namespace brainshift::solve
