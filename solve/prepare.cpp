// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/prepare.hpp"

#include <cmath>
#include <stdexcept>

#include "solve/check_model.hpp"
#include "solve/dynamics/stiffness_bound.hpp"
#include "solve/material/material_table.hpp"
#include "solve/ordered_cloud.hpp"
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

/// A node that no integration point sees has no mass, and nothing would hold it.
void check_supported(const PointBlocks& blocks, const OrderedCloud& cloud) {
  for (std::size_t a = 0; a < blocks.nodes(); ++a) {
    if (blocks.node_begin[a] == blocks.node_begin[a + 1]) {
      throw std::invalid_argument(
          "node " + std::to_string(cloud.original[a]) +
          " lies in the support of no integration point: the cells do not cover the cloud there, "
          "or are too coarse for its spacing");
    }
  }
}

std::vector<std::int32_t> tissues_of(const std::map<std::int32_t, Material>& materials) {
  std::vector<std::int32_t> tissues;
  for (const auto& [label, material] : materials) {
    tissues.push_back(label);
  }
  return tissues;
}

/// Forces on the parameters under the full load, µN; empty when nothing pushes.
NodalVectors external_force(const Model& model, const OrderedCloud& cloud, const ShapeRows& nodal_rows,
                            const IntegrationPoints& points, const ShapeRows& point_rows) {
  const bool gravity = !model.gravity.isZero();
  if (cloud.force.rows() == 0 && !gravity && !model.body_force) {
    return {};
  }
  NodalVectors force(4 * model.cloud.size(), 0.0);
  if (cloud.force.rows() > 0) {
    add_nodal_force(cloud.force, nodal_rows, force);
  }
  if (gravity) {
    constexpr double per_cubic_millimetre = 1e-9;  // kg/m³ m/s² to N/mm³
    add_body_force(
        [&](const Eigen::Vector3d&, std::int32_t label) -> Eigen::Vector3d {
          return per_cubic_millimetre * model.materials.at(label).density * model.gravity;
        },
        points, point_rows, force);
  }
  if (model.body_force) {
    add_body_force(model.body_force, points, point_rows, force);
  }
  return force;
}

/// The laws as stepping needs them: at rest relaxed materials have relaxed.
PointLaws point_laws(const MaterialTable& table, Plane plane, Dynamics dynamics) {
  PointLaws laws;
  for (const Material& m : table.material) {
    laws.elastic.push_back(elastic_law(dynamics == Dynamics::relaxation ? long_term(m) : m));
  }
  laws.plane_stress = plane == Plane::stress;
  laws.in_time = dynamics == Dynamics::transient;
  return laws;
}

AdaptivePoints place_points(const Model& model, const ShapeFunctions& shape, const SolveOptions& options) {
  const LabelMap* labels = model.labels ? &*model.labels : nullptr;
  const std::vector<std::int32_t> tissues = tissues_of(model.materials);
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

PlacedPoints in_order(const IntegrationPoints& points, const std::vector<std::int32_t>& order) {
  PlacedPoints placed{points.positions(order, Eigen::all), {}};
  for (const std::int32_t p : order) {
    placed.tissue.push_back(points.label[static_cast<std::size_t>(p)]);
  }
  return placed;
}

void measure_sizes(const OrderedCloud& cloud, const AdaptivePoints& placed, SolveMeasures& m) {
  m.nodes = cloud.original.size();
  m.integration_points = placed.points.size();
  m.capped_points = placed.capped;
  m.pairs = placed.rows.node.size();
  m.mean_support = static_cast<double>(m.pairs) / static_cast<double>(m.integration_points);
  m.grown_supports = placed.rows.grown;
  m.outside_label = placed.points.labelled_by_cell;
  m.loaded_nodes = count_loaded(cloud);
}

}  // namespace

SolveOptions completed(SolveOptions options, const Model& model) {
  options.shape.planar = model.plane != Plane::none;
  return options;
}

Prepared prepare(const Model& model, const SolveOptions& options, std::span<const std::uint8_t> pinned,
                 SolveMeasures& measures, const Progress& progress) {
  const OrderedCloud cloud = order_nodes(model.cloud);
  check_model(model, cloud, options.dynamics);
  report(progress, 0, "evaluating shape functions");
  const ShapeFunctions shape(cloud.positions, cloud.spacing, options.shape);
  const std::vector<std::int32_t> held = pinned_nodes(cloud, pinned);
  ShapeRows nodal_rows = shape.evaluate(cloud.positions, false);
  if (!held.empty()) {
    nodal_rows = with_pinned(nodal_rows, held);
  }
  AdaptivePoints placed = place_points(model, shape, options);
  auto& [points, point_rows, capped] = placed;
  MaterialTable materials = material_table(model.materials, points.label);
  measure_sizes(cloud, placed, measures);
  if (options.integration == Integration::consistent) {
    const ConsistencyMeasures done = make_derivatives_consistent(cloud.positions, surface_nodes(cloud), nodal_rows,
                                                                 points.volume, options.consistency_defect, point_rows);
    measures.consistency_iterations = done.iterations;
  }
  const bool shared_pressure = options.volumetric == Volumetric::mean_dilatation && model.plane != Plane::stress;
  const PressurePatches patches =
      pressure_patches(points.positions, nodes_per_point(points, point_rows, cloud.spacing), materials.row_of_point,
                       shared_pressure ? options.nodes_per_patch : 0);
  PointBlocks blocks =
      point_blocks(points, point_rows, materials.row_of_point, model.cloud.size(), patches, options.precision);
  check_supported(blocks, cloud);

  EssentialConditions essential(cloud.prescribed, nodal_rows, cloud.original, options.imposition);
  essential.count_as_held(held);
  std::optional<Contact> contact;
  if (model.skull) {
    contact.emplace(SignedDistance(*model.skull), cloud.positions, free_surface_nodes(cloud), nodal_rows);
  }
  const bool in_time = options.dynamics == Dynamics::transient;
  std::vector<double> mass = in_time ? physical_mass(blocks, materials.density) : std::vector<double>();
  NodalVectors external = external_force(model, cloud, nodal_rows, points, point_rows);
  return {cloud.original,
          std::move(nodal_rows),
          std::move(blocks),
          in_order(points, patches.order),
          point_laws(materials, model.plane, options.dynamics),
          in_time ? std::move(materials.prony) : std::vector<std::vector<PronyTerm>>(),
          std::move(mass),
          std::move(essential),
          std::move(contact),
          std::move(external)};
}

}  // namespace brainshift::solve
