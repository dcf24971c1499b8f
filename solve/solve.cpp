// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/solve.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "solve/boundary/contact.hpp"
#include "solve/boundary/essential_conditions.hpp"
#include "solve/boundary/signed_distance.hpp"
#include "solve/dynamics/relaxation.hpp"
#include "solve/dynamics/space_filling.hpp"
#include "solve/dynamics/stiffness_bound.hpp"
#include "solve/dynamics/transient.hpp"
#include "solve/material/material_table.hpp"
#include "solve/quadrature/integration_points.hpp"
#include "solve/quadrature/pressure_patches.hpp"
#include "solve/shape/consistent_derivatives.hpp"

namespace brainshift::solve {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The cloud with its nodes along a space-filling curve, and where each came from.
struct OrderedCloud {
  Points positions;
  Points prescribed;
  Points force;  ///< N; no rows: none
  std::vector<double> spacing;
  std::vector<std::uint8_t> on_surface;
  std::vector<std::int32_t> original;  ///< the cloud's node
};

OrderedCloud order_nodes(const NodeCloud& cloud) {
  OrderedCloud ordered;
  ordered.original = space_filling_order(cloud.positions);
  const auto n = static_cast<Eigen::Index>(cloud.size());
  ordered.positions.resize(n, 3);
  ordered.prescribed = Points::Constant(n, 3, std::nan(""));
  ordered.force.resize(cloud.force.rows(), 3);
  for (Eigen::Index a = 0; a < n; ++a) {
    const std::int32_t from = ordered.original[static_cast<std::size_t>(a)];
    ordered.positions.row(a) = cloud.positions.row(from);
    ordered.spacing.push_back(cloud.spacing[static_cast<std::size_t>(from)]);
    ordered.on_surface.push_back(cloud.on_surface[static_cast<std::size_t>(from)]);
    if (cloud.prescribed_displacement.rows() == n) {
      ordered.prescribed.row(a) = cloud.prescribed_displacement.row(from);
    }
    if (cloud.force.rows() == n) {
      ordered.force.row(a) = cloud.force.row(from);
    }
  }
  return ordered;
}

/// Rigid motions that the conditions leave free make the steady state undefined. A plane has three, x, y and the turn
/// about z, else there are six.
void check_held(const OrderedCloud& cloud, Plane plane, bool contact) {
  std::vector<Eigen::Matrix<double, 1, 6>> rows;
  const Eigen::RowVector3d centre = cloud.positions.colwise().mean();
  const double size = (cloud.positions.rowwise() - centre).cwiseAbs().maxCoeff();
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    const Eigen::Vector3d x = (cloud.positions.row(a) - centre) / size;
    const Eigen::Matrix3d turn{{0, x.z(), -x.y()}, {-x.z(), 0, x.x()}, {x.y(), -x.x(), 0}};
    for (int axis = 0; axis < (plane == Plane::none ? 3 : 2); ++axis) {
      if (!std::isnan(cloud.prescribed(a, axis))) {
        Eigen::Matrix<double, 1, 6> row;
        row << Eigen::RowVector3d::Unit(axis), turn.row(axis);
        rows.push_back(row);
      }
    }
  }
  if (rows.empty()) {
    throw std::invalid_argument("nothing is prescribed: no node is loaded or held; give a load");
  }
  Eigen::Matrix<double, 6, 6> held = Eigen::Matrix<double, 6, 6>::Zero();
  for (const auto& row : rows) {
    held += row.transpose() * row;
  }
  const Eigen::JacobiSVD<Eigen::Matrix<double, 6, 6>> svd(held);
  const int motions = plane == Plane::none ? 6 : 3;
  if (!contact && svd.singularValues()[motions - 1] < 1e-9 * svd.singularValues()[0]) {
    throw std::invalid_argument(
        "the prescribed displacements leave the body free to move as a whole, and there is no skull to stop it: hold " +
        std::string(plane == Plane::none ? "three nodes that are not in line, or add contact" : "two nodes"));
  }
}

void check_plane(const Model& model) {
  const bool planar = model.plane != Plane::none;
  if (planar != is_planar(model.cells.kind)) {
    throw std::invalid_argument(planar ? "a plane problem needs cells that are quadrilaterals or triangles"
                                       : "the cells are planar; say whether it is plane strain or plane stress");
  }
  if (planar && model.skull) {
    throw std::invalid_argument("contact with a skull needs three dimensions; leave it out of a plane problem");
  }
  for (const auto& [label, material] : model.materials) {
    if (model.plane == Plane::stress && !material.prony.empty()) {
      throw std::invalid_argument("the material of label " + std::to_string(label) +
                                  " relaxes, which plane stress does not model; take plane strain or no Prony terms");
    }
  }
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

std::vector<std::int32_t> contact_nodes(const OrderedCloud& cloud) {
  std::vector<std::int32_t> nodes;
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    if (cloud.on_surface[static_cast<std::size_t>(a)] != 0 && cloud.prescribed.row(a).array().isNaN().all()) {
      nodes.push_back(static_cast<std::int32_t>(a));
    }
  }
  return nodes;
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

Points in_original_order(const Points& values, const std::vector<std::int32_t>& original) {
  Points result(values.rows(), 3);
  for (std::size_t a = 0; a < original.size(); ++a) {
    result.row(original[a]) = values.row(static_cast<Eigen::Index>(a));
  }
  return result;
}

std::vector<std::int32_t> tissues_of(const std::map<std::int32_t, Material>& materials) {
  std::vector<std::int32_t> tissues;
  for (const auto& [label, material] : materials) {
    tissues.push_back(label);
  }
  return tissues;
}

std::size_t count_loaded(const OrderedCloud& cloud) {
  std::size_t loaded = 0;
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    const bool pushed = cloud.force.rows() > 0 && !cloud.force.row(a).isZero();
    loaded += pushed || !cloud.prescribed.row(a).array().isNaN().all() ? 1 : 0;
  }
  return loaded;
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

std::vector<std::int32_t> surface_nodes(const OrderedCloud& cloud) {
  std::vector<std::int32_t> nodes;
  for (std::size_t a = 0; a < cloud.on_surface.size(); ++a) {
    if (cloud.on_surface[a] != 0) {
      nodes.push_back(static_cast<std::int32_t>(a));
    }
  }
  return nodes;
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

SteppingResult step_in_time(const System& system, const MaterialTable& table, const SolveOptions& options,
                            const Progress& progress) {
  std::vector<double> density;
  std::vector<std::vector<PronyTerm>> prony;
  bool relaxing = false;
  for (const Material& m : table.material) {
    density.push_back(density_per_cubic_millimetre(m));
    prony.push_back(m.prony);
    relaxing = relaxing || !m.prony.empty();
  }
  if (!relaxing) {
    prony.clear();
  }
  return march(system, prony, physical_mass(system.points, density), options, progress);
}

double physical_critical_step(const PointBlocks& blocks, const PointLaws& laws, const MaterialTable& table) {
  std::vector<double> density;
  for (const Material& m : table.material) {
    density.push_back(density_per_cubic_millimetre(m));
  }
  ForceScratch scratch(blocks, laws);
  NodalVectors rest(4 * blocks.nodes(), 0.0), force(rest);
  internal_force(blocks, laws, rest, scratch, force);
  return critical_step(stiffness_bound(blocks, laws, scratch), physical_mass(blocks, density));
}

}  // namespace

SolveResult solve(const Model& model, const SolveOptions& given, const Progress& progress) {
  const auto start = Clock::now();
  SolveOptions options = given;
  options.shape.planar = model.plane != Plane::none;
  check_plane(model);
  const OrderedCloud cloud = order_nodes(model.cloud);
  if (options.dynamics == Dynamics::relaxation) {
    check_held(cloud, model.plane, model.skull.has_value());
  }

  report(progress, 0, "placing integration points");
  const IntegrationPoints points = integration_points(
      model.cells, options.points_per_cell, model.labels ? &*model.labels : nullptr, tissues_of(model.materials));
  const MaterialTable materials = material_table(model.materials, points.label);

  report(progress, 0.01, "evaluating shape functions");
  const ShapeFunctions shape(cloud.positions, cloud.spacing, options.shape);
  const ShapeRows nodal_rows = shape.evaluate(cloud.positions, false);
  ShapeRows point_rows = shape.evaluate(points.positions, true);
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
  const PointBlocks blocks = point_blocks(points, point_rows, materials.row_of_point, model.cloud.size(), patches);
  check_supported(blocks, cloud);

  const PointLaws laws = point_laws(materials, model.plane, options.dynamics);
  EssentialConditions essential(cloud.prescribed, nodal_rows, cloud.original, options.imposition);
  std::optional<SignedDistance> skull;
  std::optional<Contact> contact;
  if (model.skull) {
    skull.emplace(*model.skull);
    contact.emplace(*skull, cloud.positions, contact_nodes(cloud), nodal_rows);
  }
  const NodalVectors external = external_force(model, cloud, nodal_rows, points, point_rows);
  const double setup = seconds_since(start);

  const auto stepping = Clock::now();
  const System system{blocks, laws, essential, contact ? &*contact : nullptr, external, model.curve};
  SteppingResult stepped = options.dynamics == Dynamics::relaxation
                               ? relax(system, options, progress)
                               : step_in_time(system, materials, options, progress);

  result.failure = stepped.failure;
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
  m.pairs = point_rows.node.size();
  m.mean_support = static_cast<double>(m.pairs) / static_cast<double>(m.integration_points);
  m.grown_supports = point_rows.grown;
  m.outside_label = points.labelled_by_cell;
  m.loaded_nodes = count_loaded(cloud);
  m.steps = stepped.steps;
  m.converged = stepped.failure.empty();
  m.error_bound = stepped.error_bound;
  m.critical_step = physical_critical_step(blocks, laws, materials);
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
