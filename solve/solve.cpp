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
#include "solve/dynamics/nodal_mass.hpp"
#include "solve/dynamics/relaxation.hpp"
#include "solve/dynamics/space_filling.hpp"
#include "solve/quadrature/integration_points.hpp"

namespace brainshift::solve {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The materials of the labels that occur, as rows of a table, and the row of each point.
struct MaterialTable {
  std::vector<NeoHookean> laws;
  std::vector<double> wave_speed;  ///< c_d, mm/s
  std::vector<std::int32_t> row_of_point;
};

void check_material(std::int32_t label, const Material& m) {
  const std::string name = "the material of label " + std::to_string(label);
  if (!(m.youngs_modulus > 0 && std::isfinite(m.youngs_modulus))) {
    throw std::invalid_argument(name + " has E = " + std::to_string(m.youngs_modulus) + " Pa; it must be positive");
  }
  if (!(m.poisson_ratio > -1 && m.poisson_ratio < 0.5)) {
    throw std::invalid_argument(name + " has nu = " + std::to_string(m.poisson_ratio) +
                                "; it must lie between -1 and 0.5, both excluded");
  }
  if (!(m.density > 0 && std::isfinite(m.density))) {
    throw std::invalid_argument(name + " has the density " + std::to_string(m.density) + " kg/m3; it must be positive");
  }
}

MaterialTable material_table(const std::map<std::int32_t, Material>& materials, const IntegrationPoints& points) {
  MaterialTable table;
  std::map<std::int32_t, std::int32_t> row_of_label;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const std::int32_t label = points.label[p];
    const auto [row, is_new] = row_of_label.try_emplace(label, static_cast<std::int32_t>(table.laws.size()));
    if (is_new) {
      const auto found = materials.find(label);
      if (found == materials.end()) {
        throw std::invalid_argument("tissue label " + std::to_string(label) +
                                    " occurs in the cells but has no material; name one for it");
      }
      check_material(label, found->second);
      table.laws.emplace_back(found->second);
      constexpr double per_cubic_mm = 1e-6;  // kg/m³ to g/mm³
      table.wave_speed.push_back(std::sqrt(table.laws.back().wave_modulus() / (found->second.density * per_cubic_mm)));
    }
    table.row_of_point.push_back(row->second);
  }
  return table;
}

/// The cloud with its nodes along a space-filling curve, and where each came from.
struct OrderedCloud {
  Points positions;
  Points prescribed;
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
  for (Eigen::Index a = 0; a < n; ++a) {
    const std::int32_t from = ordered.original[static_cast<std::size_t>(a)];
    ordered.positions.row(a) = cloud.positions.row(from);
    ordered.spacing.push_back(cloud.spacing[static_cast<std::size_t>(from)]);
    ordered.on_surface.push_back(cloud.on_surface[static_cast<std::size_t>(from)]);
    if (cloud.prescribed_displacement.rows() == n) {
      ordered.prescribed.row(a) = cloud.prescribed_displacement.row(from);
    }
  }
  return ordered;
}

/// Rigid motions that the conditions leave free make the steady state undefined.
void check_held(const OrderedCloud& cloud, bool contact) {
  std::vector<Eigen::Matrix<double, 1, 6>> rows;
  const Eigen::RowVector3d centre = cloud.positions.colwise().mean();
  const double size = (cloud.positions.rowwise() - centre).cwiseAbs().maxCoeff();
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    const Eigen::Vector3d x = (cloud.positions.row(a) - centre) / size;
    const Eigen::Matrix3d turn{{0, x.z(), -x.y()}, {-x.z(), 0, x.x()}, {x.y(), -x.x(), 0}};
    for (int axis = 0; axis < 3; ++axis) {
      if (!std::isnan(cloud.prescribed(a, axis))) {
        Eigen::Matrix<double, 1, 6> row = Eigen::Matrix<double, 1, 6>::Zero();
        row[axis] = 1;
        row.tail<3>() = turn.row(axis);
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
  if (!contact && svd.singularValues()[5] < 1e-9 * svd.singularValues()[0]) {
    throw std::invalid_argument(
        "the prescribed displacements leave the body free to move as a whole, and there is no skull to stop it: hold "
        "three nodes that are not in line, or add contact");
  }
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

std::size_t count_loaded(const Points& prescribed) {
  std::size_t loaded = 0;
  for (Eigen::Index a = 0; a < prescribed.rows(); ++a) {
    loaded += prescribed.row(a).array().isNaN().all() ? 0 : 1;
  }
  return loaded;
}

}  // namespace

SolveResult solve(const Model& model, const SolveOptions& options, const Progress& progress) {
  const auto start = Clock::now();
  const OrderedCloud cloud = order_nodes(model.cloud);
  check_held(cloud, model.skull.has_value());

  report(progress, 0, "placing integration points");
  const IntegrationPoints points = integration_points(
      model.cells, options.points_per_cell, model.labels ? &*model.labels : nullptr, tissues_of(model.materials));
  const MaterialTable materials = material_table(model.materials, points);

  report(progress, 0.01, "evaluating shape functions");
  const ShapeFunctions shape(cloud.positions, cloud.spacing, options.shape);
  const ShapeRows nodal_rows = shape.evaluate(cloud.positions, false);
  const ShapeRows point_rows = shape.evaluate(points.positions, true);
  const PointBlocks blocks = point_blocks(points, point_rows, materials.row_of_point, model.cloud.size(),
                                          options.volumetric == Volumetric::mean_dilatation);

  check_supported(blocks, cloud);
  EssentialConditions essential(cloud.prescribed, nodal_rows, cloud.original);
  std::optional<SignedDistance> skull;
  std::optional<Contact> contact;
  if (model.skull) {
    skull.emplace(*model.skull);
    contact.emplace(*skull, cloud.positions, contact_nodes(cloud), nodal_rows);
  }
  const double setup = seconds_since(start);

  const auto stepping = Clock::now();
  RelaxationResult relaxed =
      relax({blocks, materials.laws, essential, contact ? &*contact : nullptr}, options, progress);

  SolveResult result;
  result.failure = relaxed.failure;
  result.history = std::move(relaxed.history);
  constexpr double newton = 1e-6;  // µN to N
  result.solution = {model.cloud.positions, nodal_displacement(nodal_rows, relaxed.parameters, cloud.original),
                     newton * in_original_order(relaxed.reactions, cloud.original), model.cloud.spacing, options.shape};
  for (const RelaxationSnapshot& s : relaxed.snapshots) {
    result.snapshots.push_back({s.step, s.time, nodal_displacement(nodal_rows, s.parameters, cloud.original)});
  }
  SolveMeasures& m = result.measures;
  m.nodes = model.cloud.size();
  m.integration_points = points.size();
  m.pairs = point_rows.node.size();
  m.mean_support = static_cast<double>(m.pairs) / static_cast<double>(m.integration_points);
  m.grown_supports = point_rows.grown;
  m.outside_label = points.labelled_by_cell;
  m.loaded_nodes = count_loaded(cloud.prescribed);
  m.steps = relaxed.steps;
  m.converged = relaxed.failure.empty();
  m.error_bound = relaxed.error_bound;
  m.critical_step = critical_step(blocks, materials.wave_speed);
  m.largest_displacement = result.solution.displacement.rowwise().norm().maxCoeff();
  m.constraint_error = essential.largest_error(relaxed.parameters);
  if (contact) {
    const Contact::Measures touch = contact->measure(relaxed.parameters);
    m.contact_nodes = touch.touching;
    m.largest_penetration = touch.largest_penetration;
  }
  m.smallest_jacobian = relaxed.state.smallest_jacobian;
  m.largest_stretch = relaxed.state.largest_stretch;
  m.seconds_setup = setup;
  m.seconds_stepping = seconds_since(stepping);
  return result;
}

}  // namespace brainshift::solve
