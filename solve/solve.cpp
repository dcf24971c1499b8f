// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/solve.hpp"

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "solve/boundary/contact.hpp"
#include "solve/boundary/essential_conditions.hpp"
#include "solve/boundary/signed_distance.hpp"
#include "solve/check_model.hpp"
#include "solve/dynamics/relaxation.hpp"
#include "solve/dynamics/stiffness_bound.hpp"
#include "solve/dynamics/transient.hpp"
#include "solve/material/material_table.hpp"
#include "solve/ordered_cloud.hpp"
#include "solve/quadrature/adaptive_points.hpp"
#include "solve/quadrature/pressure_patches.hpp"
#include "solve/shape/consistent_derivatives.hpp"

namespace brainshift::solve {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

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

/// Displacement at the nodes, u = Σφû, in the cloud's order.
Points nodal_displacement(const ShapeRows& rows, const NodalVectors& parameters,
                          const std::vector<std::int32_t>& original) {
  Points displacement(static_cast<Eigen::Index>(rows.size()), 3);
  for (std::size_t a = 0; a < rows.size(); ++a) {
    Eigen::Vector3d u = Eigen::Vector3d::Zero();
    for (auto k = static_cast<std::size_t>(rows.begin[a]); k < static_cast<std::size_t>(rows.begin[a + 1]); ++k) {
      u += rows.value[k] * Eigen::Map<const Eigen::Vector3d>(&parameters[4 * static_cast<std::size_t>(rows.node[k])]);
    }
    displacement.row(original[a]) = u;
  }
  return displacement;
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

}  // namespace

SolveResult solve(const Model& model, const SolveOptions& given, const Progress& progress) {
  const auto start = Clock::now();
  SolveOptions options = given;
  options.shape.planar = model.plane != Plane::none;
  const OrderedCloud cloud = order_nodes(model.cloud);
  check_model(model, cloud, options.dynamics);

  report(progress, 0, "evaluating shape functions");
  const ShapeFunctions shape(cloud.positions, cloud.spacing, options.shape);
  const ShapeRows nodal_rows = shape.evaluate(cloud.positions, false);
  auto [points, point_rows, capped] = place_points(model, shape, options);
  const MaterialTable materials = material_table(model.materials, points.label);
  SolveResult result;
  if (options.integration == Integration::consistent) {
    const ConsistencyMeasures done = make_derivatives_consistent(cloud.positions, surface_nodes(cloud), nodal_rows,
                                                                 points.volume, options.consistency_defect, point_rows);
    result.measures.consistency_iterations = done.iterations;
  }
  const bool shared_pressure = options.volumetric == Volumetric::mean_dilatation && model.plane != Plane::stress;
  const PressurePatches patches =
      pressure_patches(points.positions, nodes_per_point(points, point_rows, cloud.spacing), materials.row_of_point,
                       shared_pressure ? options.nodes_per_patch : 0);
  const PointBlocks blocks =
      point_blocks(points, point_rows, materials.row_of_point, model.cloud.size(), patches, options.precision);
  check_supported(blocks, cloud);

  const PointLaws laws = point_laws(materials, model.plane, options.dynamics);
  EssentialConditions essential(cloud.prescribed, nodal_rows, cloud.original, options.imposition);
  std::optional<SignedDistance> skull;
  std::optional<Contact> contact;
  if (model.skull) {
    skull.emplace(*model.skull);
    contact.emplace(*skull, cloud.positions, free_surface_nodes(cloud), nodal_rows);
  }
  const NodalVectors external = external_force(model, cloud, nodal_rows, points, point_rows);
  const double setup = seconds_since(start);

  const auto stepping = Clock::now();
  const System system{blocks, laws, essential, contact ? &*contact : nullptr, external, model.curve};
  SteppingResult stepped =
      options.dynamics == Dynamics::relaxation
          ? relax(system, options, progress)
          : march(system, materials.prony, physical_mass(blocks, materials.density), options, progress);

  result.failure = stepped.failure;
  if (stepped.fault) {
    result.failure += ' ';
    result.failure += describe(*stepped.fault, {blocks, laws, cloud, points.positions, points.label, patches.order});
  }
  result.history = std::move(stepped.history);
  constexpr double newton = 1e-6;  // µN to N
  result.solution = {model.cloud.positions, nodal_displacement(nodal_rows, stepped.parameters, cloud.original),
                     newton * in_original_order(stepped.reactions, cloud.original), model.cloud.spacing, options.shape};
  for (const ParameterSnapshot& s : stepped.snapshots) {
    result.snapshots.push_back({s.step, s.time, nodal_displacement(nodal_rows, s.parameters, cloud.original)});
  }
  SolveMeasures& m = result.measures;
  m.nodes = model.cloud.size();
  m.integration_points = points.size();
  m.capped_points = capped;
  m.pairs = point_rows.node.size();
  m.mean_support = static_cast<double>(m.pairs) / static_cast<double>(m.integration_points);
  m.grown_supports = point_rows.grown;
  m.outside_label = points.labelled_by_cell;
  m.loaded_nodes = count_loaded(cloud);
  m.steps = stepped.steps;
  m.converged = stepped.failure.empty();
  m.error_bound = stepped.error_bound;
  m.critical_step = stepped.critical_step;
  m.largest_displacement = result.solution.displacement.rowwise().norm().maxCoeff();
  m.constraint_error = essential.largest_error(stepped.fraction, stepped.parameters);
  if (contact) {
    const Contact::Measures touch = contact->measure(stepped.parameters);
    m.contact_nodes = touch.touching;
    m.largest_penetration = touch.largest_penetration;
  }
  m.smallest_jacobian = stepped.state.smallest_jacobian;
  m.largest_stretch = stepped.state.largest_stretch;
  m.seconds_setup = setup;
  m.seconds_stepping = seconds_since(stepping);
  return result;
}

}  // namespace brainshift::solve
