// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/solve_cost.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brainshift::pipelines {
namespace {

// Bytes, from run.json of the demo's head (12,000 nodes, 75,750 points, 3.5 million pairs, 93 loaded nodes, two
// threads, single precision): shape functions 64.3 MB, nodal vectors and scratch 4.8, pressure patches 2.4, essential
// conditions 0.30, contact 8.4.
constexpr double pair_bytes = 27, pair_bytes_single = 14.5;  // derivatives and a slot, padded
constexpr double point_bytes = 46;                           // place, tissue, volume, offsets
constexpr double node_row_bytes = 780;                       // shape functions at the node itself, and its slots
constexpr double node_bytes = 400;
constexpr double patch_bytes = 32;  // four pressure modes a point
constexpr double condition_bytes = 1700, condition_node_bytes = 12;
constexpr double contact_bytes = 570;
constexpr double loaded_share = 0.033;  // of the surface nodes

// Nanoseconds of one core a step, from `bash tests/benchmark/parts.sh 8000 3` (50,500 points, double precision): 9 ms
// without any part; contact 1.2 ms more, two Prony terms 4.7, gravity and pressure patches none; the pairs of single
// precision from tests/benchmark/run.sh. That of the essential conditions and the division of the 9 ms are not
// measured, but guessed.
constexpr double pair_time = 3.2, pair_time_single = 2.0, point_time = 16, node_time = 60;
constexpr double contact_time = 500, viscous_time = 93, external_time = 1, condition_time = 300, swelling_time = 3;
constexpr double levels_in_time = 32;  // of a fluid that drains in a transient run: solve/body/lay_out.cpp

/// Nodes on the surface of a ball of as many, a brain's folds having none of their own.
double surface_nodes(double nodes) {
  return std::min(nodes, 6 * std::pow(nodes, 2.0 / 3));
}

/// Nodes on the two sides of sheets as large as falx and tentorium, 0.9 V^(2/3): pairs 0.85 spacings apart.
double faces_at_septa(double nodes) {
  return 2.5 * std::pow(nodes, 2.0 / 3);
}

/// Samples of the distance to the skull, and a part of them past it (solve/body/lay_out.cpp).
double distance_samples(double volume, double nodes) {
  const double width = std::cbrt(6 * volume / std::numbers::pi), spacing = std::cbrt(volume / nodes);
  const double step = std::min(1.5, std::max(spacing / 3, width / 200));
  return std::pow(width / step + 14, 3);
}

/// The first tissue that relaxes in a transient run, and its Prony terms; null: none.
const Tissue* relaxing(const Scene& scene) {
  if (scene.solve.dynamics == solve::Dynamics::transient) {
    for (const Tissue& tissue : scene.tissues) {
      if (!tissue.material.prony.empty()) {
        return &tissue;
      }
    }
  }
  return nullptr;
}

/// The first tissue that swells; null: none.
const Tissue* swelling(const Scene& scene) {
  const auto found = std::find_if(scene.tissues.begin(), scene.tissues.end(),
                                  [](const Tissue& tissue) { return tissue.material.swelling != 0; });
  return found == scene.tissues.end() ? nullptr : &*found;
}

}  // namespace

std::vector<PartCost> solve_costs(const Scene& scene, const SolveSize& size) {
  const bool single = scene.solve.precision == solve::Precision::single_precision;
  std::vector<PartCost> costs = {
      {"shape functions and stress", "",
       size.pairs * (single ? pair_bytes_single : pair_bytes) + size.points * point_bytes + size.nodes * node_row_bytes,
       size.pairs * (single ? pair_time_single : pair_time) + size.points * point_time},
      {"nodal vectors and scratch", "", size.nodes * node_bytes, size.nodes * node_time}};
  if (scene.solve.volumetric == solve::Volumetric::mean_dilatation) {
    costs.push_back({"pressure patches", "solve.volumetric", size.points * patch_bytes, 0});
  }
  if (scene.load) {
    const double loaded = loaded_share * surface_nodes(size.nodes);
    costs.push_back({"essential conditions", "load", loaded * condition_bytes + size.nodes * condition_node_bytes,
                     loaded * condition_time});
  }
  if (scene.contact) {
    const double touching = surface_nodes(size.nodes);
    costs.push_back({"contact", "contact",
                     distance_samples(size.volume, size.nodes) * sizeof(float) + touching * contact_bytes,
                     touching * contact_time});
  }
  if (scene.septa || scene.septum) {
    const double faces = faces_at_septa(size.nodes);
    costs.push_back({"septum", scene.septa ? "septa" : "septum", faces * contact_bytes, faces * contact_time});
  }
  if (const Tissue* tissue = relaxing(scene)) {
    const double terms = static_cast<double>(tissue->material.prony.size());
    costs.push_back({"relaxation of the materials", "tissues." + std::to_string(tissue->label),
                     size.points * (8 + 48 * (1 + terms)), size.points * viscous_time * (1 + terms) / 3});
  }
  if (!scene.loading.gravity.isZero() || scene.gravity) {
    const double levels = scene.gravity && scene.solve.dynamics == solve::Dynamics::transient ? levels_in_time : 1;
    costs.push_back(
        {"gravity", scene.gravity ? "gravity" : "solve.gravity", levels * size.nodes * 32, size.nodes * external_time});
  }
  if (const Tissue* tissue = swelling(scene)) {
    costs.push_back({"swelling", "tissues." + std::to_string(tissue->label),
                     8.0 * static_cast<double>(scene.tissues.size()), size.points * swelling_time});
  }
  return costs;
}

}  // namespace brainshift::pipelines
