// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/stage_memory.hpp"

#include <algorithm>

#include "pipelines/scene/scene_labels.hpp"

namespace brainshift::pipelines {
namespace {

// /usr/bin/time measured phantoms of 24³ to 192³ voxels and the demo's head of 7.1 million, with 300 to 48,000 nodes,
// on one to four threads. The constants are such that no run held more; the figures stand in stage_memory_test.cpp.
constexpr double mb = 1e6;
constexpr double program = 66;         // MB: what is loaded before there is any data
constexpr double fine_surface = 26;    // MB: of 27,000 vertices, as coarse voxels have them: edges follow the voxel
constexpr double reading_labels = 13;  // bytes a voxel: doubles, the file's own numbers, labels

double segment_memory(const Scene& scene, const RunSize& size) {
  // Images and masks; of a mask the tissues are classified, with an image of each class's memberships.
  const bool classified = scene.image.labels.empty();
  const double voxel = classified ? 40 + 4.0 * scene.segment.classes : label_reading(scene).by_class ? 27 : 22;
  const double other_grid = size.label_voxels == size.voxels ? 0 : size.label_voxels * reading_labels;
  return program + fine_surface + 4 + (size.voxels * voxel + other_grid) / mb;
}

double discretise_memory(const RunSize& size) {
  const double reading = size.voxels * reading_labels / mb;
  return program + std::max(reading, fine_surface + size.solve.nodes * 800 / mb);
}

double solve_memory(const Scene& scene, const RunSize& size) {
  const bool single = scene.solve.precision == solve::Precision::single_precision;
  constexpr double node = 1500;
  const double pair = single ? 60 : 73;  // with what is held while shape functions are made
  double bytes = size.solve.pairs * pair + size.solve.nodes * node + size.voxels * 2;
  const std::vector<PartCost> parts = solve_costs(scene, size.solve);
  for (std::size_t i = 1; i < parts.size(); ++i) {  // the first are the shape functions
    bytes += parts[i].bytes;
  }
  constexpr double surfaces = 18;  // MB: brain and skull with their trees
  return program + std::max(size.voxels * reading_labels / mb, surfaces + bytes / mb);
}

double register_memory(const Scene& scene, const RunSize& size) {
  // Two fields, a copy of each while it is written, one beside the other where there are threads; images, zones.
  const double voxel = scene.registration.interpolation == registration::Interpolation::bspline ? 98 : 90;
  constexpr double least = 42;
  return program + std::max(least, 9 + size.voxels * voxel / mb);
}

double report_memory(const RunSize& size) {
  constexpr double pictures = 42, voxel = 44;
  return program + pictures + size.voxels * voxel / mb;
}

}  // namespace

std::optional<double> stage_memory(StageId stage, const Scene& scene, const RunSize& size) {
  switch (stage) {
    case StageId::segment:
      return segment_memory(scene, size);
    case StageId::discretise:
      return discretise_memory(size);
    case StageId::solve:
      return scene.solve.integration_tolerance > 0 ? std::nullopt : std::optional(solve_memory(scene, size));
    case StageId::registration:
      return register_memory(scene, size);
    case StageId::report:
      return report_memory(size);
  }
  return std::nullopt;
}

}  // namespace brainshift::pipelines
