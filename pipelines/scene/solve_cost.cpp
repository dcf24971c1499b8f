// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/solve_cost.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brainshift::pipelines {
namespace {

// Bytes, from run.json of the demo's head (12,000 nodes, 75,750 points, 3.5 million pairs, 93 loaded nodes): shape
// functions 104.5 MB, nodal vectors 13.2, essential conditions 0.30, contact 12.4 of which 10.8 are distances.
constexpr double pair_bytes = 26;        // three doubles and a slot
constexpr double node_row_bytes = 1500;  // shape functions at the node itself, and its slots
constexpr double point_bytes = 72;       // F
constexpr double node_bytes = 640;
constexpr double patch_bytes = 32;  // four pressure modes a point
constexpr double condition_bytes = 1700, condition_node_bytes = 12;
constexpr double contact_bytes = 570;
constexpr double loaded_share = 0.033;  // of the surface nodes

// Nanoseconds of one core a step, from `bash tests/benchmark/parts.sh 8000 2` (50,500 points): 14.2 ms without any
// part; pressure patches 0.73 ms more, contact 0.44, two Prony terms 3.0, gravity not to be measured. That of the
// essential conditions and the division of the 14.2 ms are not measured, but guessed.
constexpr double pair_time = 5, point_time = 50, node_time = 30;
constexpr double patch_time = 14, contact_time = 180, viscous_time = 59, external_time = 1, condition_time = 300;

/// Nodes on the surface of a ball of as many, a brain's folds having none of their own.
double surface_nodes(double nodes) {
  return std::min(nodes, 6 * std::pow(nodes, 2.0 / 3));
}

/// Samples of the distance to the skull: 1.5 mm apart, 25 mm past the surface (solve/boundary/signed_distance.hpp).
double distance_samples(double volume) {
  const double width = std::cbrt(6 * volume / std::numbers::pi) + 50;
  return std::pow(width / 1.5, 3);
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

}  // namespace

std::vector<PartCost> solve_costs(const Scene& scene, const SolveSize& size) {
  const bool single = scene.solve.precision == solve::Precision::single_precision;
  std::vector<PartCost> costs = {
      {"shape functions and stress", "",
       size.pairs * (single ? pair_bytes / 2 : pair_bytes) + size.nodes * node_row_bytes,
       size.pairs * pair_time + size.points * point_time},
      {"nodal vectors and scratch", "", size.points * point_bytes + size.nodes * node_bytes, size.nodes * node_time}};
  if (scene.solve.volumetric == solve::Volumetric::mean_dilatation) {
    costs.push_back({"pressure patches", "solve.volumetric", size.points * patch_bytes, size.points * patch_time});
  }
  if (scene.load) {
    const double loaded = loaded_share * surface_nodes(size.nodes);
    costs.push_back({"essential conditions", "load", loaded * condition_bytes + size.nodes * condition_node_bytes,
                     loaded * condition_time});
  }
  if (scene.contact) {
    const double touching = surface_nodes(size.nodes);
    costs.push_back({"contact", "contact", distance_samples(size.volume) * sizeof(float) + touching * contact_bytes,
                     touching * contact_time});
  }
  if (const Tissue* tissue = relaxing(scene)) {
    const double terms = static_cast<double>(tissue->material.prony.size());
    costs.push_back({"relaxation of the materials", "tissues." + std::to_string(tissue->label),
                     size.points * (8 + 48 * (1 + terms)), size.points * viscous_time * (1 + terms) / 3});
  }
  if (!scene.loading.gravity.isZero()) {
    costs.push_back({"gravity", "solve.gravity", size.nodes * 32, size.nodes * external_time});
  }
  return costs;
}

}  // namespace brainshift::pipelines
