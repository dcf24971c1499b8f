// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/prepare.hpp"

#include <algorithm>
#include <stdexcept>

#include "solve/check_model.hpp"
#include "solve/cut/cut_patches.hpp"
#include "solve/cut/resection.hpp"
#include "solve/lay_out.hpp"
#include "solve/quadrature/adaptive_points.hpp"
#include "solve/quadrature/pressure_patches.hpp"
#include "solve/shape/consistent_derivatives.hpp"

namespace brainshift::solve {

namespace {

/// The nodes that each integration point stands for: its volume over that of a node there, scaled to their number.
std::vector<double> nodes_per_point(const IntegrationPoints& points, const ShapeRows& rows,
                                    std::span<const double> spacing) {
  std::vector<double> share(points.size());
  double total = 0;
  for (std::size_t p = 0; p < share.size(); ++p) {
    double cube = 0;
    for (std::int64_t k = rows.begin[p]; k < rows.begin[p + 1]; ++k) {
      const double s = spacing[static_cast<std::size_t>(rows.node[static_cast<std::size_t>(k)])];
      cube += s * s * s / static_cast<double>(rows.begin[p + 1] - rows.begin[p]);
    }
    share[p] = points.volume[p] / cube;
    total += share[p];
  }
  for (double& s : share) {
    s *= static_cast<double>(spacing.size()) / total;
  }
  return share;
}

AdaptivePoints place_points(const Model& model, const ShapeFunctions& shape, const SolveOptions& options) {
  const LabelMap* labels = model.labels ? &*model.labels : nullptr;
  const std::vector<std::int32_t> tissues = tissues_of(model);
  if (options.integration_tolerance > 0) {
    const AdaptiveRule rule{options.integration_tolerance, options.integration_depth, options.points_per_cell};
    return adaptive_points(model.cells, shape, rule, labels, tissues);
  }
  AdaptivePoints plain{integration_points(model.cells, options.points_per_cell, labels, tissues), {}};
  plain.rows = shape.evaluate(plain.points.positions, true);
  return plain;
}

/// The ordered nodes whose parameter is prescribed.
std::vector<std::int32_t> pinned_nodes(const OrderedCloud& cloud, std::span<const std::uint8_t> pinned) {
  std::vector<std::int32_t> nodes;
  for (std::size_t a = 0; a < cloud.original.size() && !pinned.empty(); ++a) {
    if (pinned[static_cast<std::size_t>(cloud.original[a])] != 0) {
      nodes.push_back(static_cast<std::int32_t>(a));
    }
  }
  return nodes;
}

/// The rows of these nodes become 1 at themselves: there u = û.
ShapeRows with_pinned(const ShapeRows& rows, std::span<const std::int32_t> pinned) {
  ShapeRows result;
  result.begin.push_back(0);
  auto next = pinned.begin();
  for (std::size_t a = 0; a < rows.size(); ++a) {
    if (next != pinned.end() && *next == static_cast<std::int32_t>(a)) {
      result.node.push_back(*next++);
      result.value.push_back(1);
    } else {
      result.node.insert(result.node.end(), rows.node.begin() + rows.begin[a], rows.node.begin() + rows.begin[a + 1]);
      result.value.insert(result.value.end(), rows.value.begin() + rows.begin[a],
                          rows.value.begin() + rows.begin[a + 1]);
    }
    result.begin.push_back(static_cast<std::int64_t>(result.node.size()));
  }
  return result;
}

void measure_sizes(const Pieces& pieces, std::size_t capped, SolveMeasures& m) {
  m.nodes = pieces.cloud.size();
  m.integration_points = pieces.points.size();
  m.capped_points = capped;
  m.pairs = pieces.point_rows.node.size();
  m.mean_support = static_cast<double>(m.pairs) / static_cast<double>(m.integration_points);
  m.grown_supports = pieces.point_rows.grown;
  m.outside_label = pieces.points.labelled_by_cell;
  m.loaded_nodes = count_loaded(pieces.cloud);
}

/// Within each patch by the nodes that points see: the processor foresees how long the loop over them is.
void order_by_support(const ShapeRows& rows, PressurePatches& patches) {
  const auto size = [&](std::int32_t p) {
    return rows.begin[static_cast<std::size_t>(p) + 1] - rows.begin[static_cast<std::size_t>(p)];
  };
  for (std::size_t i = 0; i < patches.size(); ++i) {
    std::stable_sort(patches.order.begin() + patches.begin[i], patches.order.begin() + patches.begin[i + 1],
                     [&](std::int32_t a, std::int32_t b) { return size(a) < size(b); });
  }
}

PressurePatches patches_of(const Model& model, const SolveOptions& options, const Pieces& pieces,
                           const Visibility* visibility) {
  const bool shared_pressure = options.volumetric == Volumetric::mean_dilatation && model.plane != Plane::stress;
  const auto& [cloud, nodal_rows, points, point_rows, none, materials] = pieces;
  PressurePatches patches = pressure_patches(points.positions, nodes_per_point(points, point_rows, cloud.spacing),
                                             materials.row_of_point, shared_pressure ? options.nodes_per_patch : 0);
  if (visibility != nullptr && shared_pressure) {
    patches = part_patches(*visibility, points.positions, patches);
  }
  order_by_support(point_rows, patches);
  return patches;
}

/// The stress of relaxing materials is not followed point by point for a tear.
void check_rupture(const Model& model, Dynamics dynamics) {
  const bool by_stress = model.rupture && model.rupture->criterion == Rupture::Criterion::stress;
  const bool relaxes = std::any_of(model.materials.begin(), model.materials.end(),
                                   [](const auto& material) { return !material.second.prony.empty(); });
  if (by_stress && relaxes && dynamics == Dynamics::transient) {
    throw std::invalid_argument(
        "a rupture by stress does not go with a material that relaxes in time; give the stretch at which it tears");
  }
}

bool cuts_go_on(const Model& model) {
  return last_time(model.cuts) > 0 || model.rupture;
}

}  // namespace

SolveOptions completed(SolveOptions options, const Model& model) {
  options.shape.planar = model.plane != Plane::none;
  return options;
}

Prepared prepare(const Model& model, const SolveOptions& options, std::span<const std::uint8_t> pinned,
                 SolveMeasures& measures, const Progress& progress) {
  check_model(model);
  check_rupture(model, options.dynamics);
  std::optional<CutBody> cut;
  if (!model.cuts.empty() || model.rupture) {
    cut = cut_body(model);
  }
  const std::shared_ptr<const Visibility> visibility = cut ? cut->visibility : nullptr;
  Pieces pieces;
  pieces.cloud = order_nodes(cut ? cut->cloud : model.cloud);
  if (options.dynamics == Dynamics::relaxation) {
    check_held(pieces.cloud, model);
  }
  report(progress, 0, "evaluating shape functions");
  const ShapeFunctions shape(pieces.cloud.positions, pieces.cloud.spacing, options.shape, visibility);
  const std::vector<std::int32_t> held = pinned_nodes(pieces.cloud, pinned);
  pieces.nodal_rows = shape.evaluate(pieces.cloud.positions, false);
  if (!held.empty()) {
    pieces.nodal_rows = with_pinned(pieces.nodal_rows, held);
  }
  AdaptivePoints placed = place_points(model, shape, options);
  if (model.resection) {
    leave_out(*model.resection, placed);
  }
  const bool may_part = visibility || model.resection;
  if (may_part && !model.face_contact && options.dynamics == Dynamics::relaxation) {  // a face may hold the other
    check_parts_held(pieces.cloud, placed.rows, model);
  }
  pieces.points = std::move(placed.points);
  pieces.point_rows = std::move(placed.rows);
  pieces.materials = material_table(model.materials, pieces.points.label);
  measure_sizes(pieces, placed.capped, measures);
  if (options.integration == Integration::consistent) {
    const ConsistencyMeasures done =
        make_derivatives_consistent(pieces.cloud.positions, surface_nodes(pieces.cloud), pieces.nodal_rows,
                                    pieces.points.volume, options.consistency_defect, pieces.point_rows);
    measures.consistency_iterations = done.iterations;
  }
  pieces.patches = patches_of(model, options, pieces, visibility.get());
  Prepared prepared = lay_out(model, options, pieces, cut ? cut->pairs : std::vector<FacePair>(), held);
  prepared.cut = std::move(cut);
  if (cuts_go_on(model)) {
    prepared.pieces = std::move(pieces);
  }
  return prepared;
}

}  // namespace brainshift::solve
