// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/run_size.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipelines/scene/scene_labels.hpp"
#include "solve/shape/node_supports.hpp"

namespace brainshift::pipelines {
namespace {

constexpr double typical_brain_volume = 1.4e6;  // mm³

bool is_brain(const Scene& scene, std::uint16_t value, bool mask) {
  if (mask) {
    return value != 0;
  }
  return std::any_of(scene.tissues.begin(), scene.tissues.end(), [&](const Tissue& t) { return t.label == value; });
}

/// The label map, or the mask in its place; may be empty.
const auto& label_file(const Scene& scene) {
  return scene.image.labels.empty() ? scene.image.brain_mask : scene.image.labels;
}

/// Nodes, points and pairs in a brain of the size's volume.
void add_solve_size(const Scene& scene, SolveSize& solve) {
  const auto& discretise = scene.discretise;
  const bool finer = discretise.tissue_boundary_factor < 1 || scene.refinement.factor < 1;
  const double denser = finer ? 1.25 : 1;  // than of the uniform spacing
  solve.nodes = discretise.spacing ? denser * solve.volume / std::pow(*discretise.spacing, 3)
                                   : static_cast<double>(discretise.nodes.value_or(12000));
  const bool hexahedra = discretise.cells == CellKind::hexahedron;
  // Delaunay tetrahedra of a cloud: about six a node.
  const double cells = solve.nodes * (hexahedra ? discretise.cells_per_node : 6);
  const int points_a_cell = scene.solve.points_per_cell.value_or(hexahedra ? 8 : 4);
  // Between tissues points are parted, and cells split where nodes are finer there: up to a fifth more.
  const double parted = scene.tissues.size() > 1 ? 1.25 : 1;
  solve.points = cells * points_a_cell * parted;
  solve.pairs = solve.points * 4 * std::numbers::pi / 3 * std::pow(solve::dilatation(scene.solve.shape), 3);
}

}  // namespace

RunSize run_size(const Scene& scene) {
  RunSize size{.solve = {.volume = typical_brain_volume}};
  const bool mask = scene.image.labels.empty();
  const auto& file = label_file(scene);
  if (!file.empty()) {
    const LabelMap map = mask ? read_mask(file) : read_labels(scene.image, label_reading(scene)).map;
    const auto count = std::count_if(map.voxels.begin(), map.voxels.end(),
                                     [&](std::uint16_t value) { return is_brain(scene, value, mask); });
    size.label_voxels = static_cast<double>(map.voxels.size());
    size.solve.volume = static_cast<double>(count) * map.geometry.voxel_volume();
  }
  const auto& t1 = scene.image.t1;
  size.voxels =
      t1.empty() || t1 == file ? size.label_voxels : static_cast<double>(read_image(t1).geometry.voxel_count());
  add_solve_size(scene, size.solve);
  return size;
}

RunSize declared_run_size(const Scene& scene) {
  RunSize size{.solve = {.volume = typical_brain_volume}};
  const auto& file = label_file(scene);
  size.label_voxels = file.empty() ? 0 : declared_voxels(file).value_or(0);
  const auto& t1 = scene.image.t1;
  size.voxels = t1.empty() || t1 == file ? size.label_voxels : declared_voxels(t1).value_or(0);
  add_solve_size(scene, size.solve);
  return size;
}

}  // namespace brainshift::pipelines
