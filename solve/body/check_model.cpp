// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/body/check_model.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "discretise/interface/background_cells.hpp"
#include "segmentation/geometry/joined_nodes.hpp"
#include "solve/body/check_discretisation.hpp"
#include "solve/body/rigid_motions.hpp"
#include "solve/boundary/wall_load.hpp"
#include "solve/interface/option_table.hpp"
#include "solve/material/check_material.hpp"

namespace brainshift::solve {

namespace {

void check_plane(const Model& model) {
  const bool planar = model.plane != Plane::none;
  if (planar != is_planar(model.cells.kind)) {
    throw std::invalid_argument(planar ? "a plane problem needs cells that are quadrilaterals or triangles"
                                       : "the cells are planar; say whether it is plane strain or plane stress");
  }
  if (planar && model.skull) {
    throw std::invalid_argument("contact with a skull needs three dimensions; leave it out of a plane problem");
  }
  const auto leaves_plane = [](const Points& of_nodes) {
    const auto along = of_nodes.col(2).array();
    return (!along.isNaN() && along != 0).any();
  };
  const bool pulled_out = model.gravity.z() != 0 || (model.fluid && model.fluid->gravity.z() != 0);
  if (planar && (pulled_out || leaves_plane(model.conditions.displacement) || leaves_plane(model.conditions.force))) {
    throw std::invalid_argument(
        "gravity, forces and displacements of a plane problem have no z; set theirs to 0, or "
        "put the problem into the plane of x and y");
  }
  for (const auto& [label, material] : model.materials) {
    if (model.plane == Plane::stress && !material.prony.empty()) {
      throw std::invalid_argument("the material of label " + std::to_string(label) +
                                  " relaxes, which plane stress does not model; take plane strain or no Prony terms");
    }
  }
}

/// Of each node the node that stands for the part that it belongs to.
std::vector<std::int32_t> parts_of(std::size_t nodes, const ShapeRows& rows) {
  JoinedNodes joined(nodes);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::span<const std::int32_t> support = rows[i].node;
    for (const std::int32_t a : support) {
      joined.join(support.front(), a);
    }
  }
  std::vector<std::int32_t> part;
  for (std::size_t a = 0; a < nodes; ++a) {
    part.push_back(joined.root(static_cast<std::int32_t>(a)));
  }
  return part;
}

/// forces: at the nodes.
bool is_pushed(const Model& model, const Points& forces) {
  const bool swells = std::any_of(model.materials.begin(), model.materials.end(),
                                  [](const auto& material) { return material.second.swelling != 0; });
  return swells || model.fluid || model.body_force || !model.gravity.isZero() || forces.rows() > 0 ||
         (model.resection && presses_on_wall(*model.resection));
}

}  // namespace

bool is_pushed(const Model& model) {
  return is_pushed(model, model.conditions.force);
}

void check_input(const Model& model) {
  check_nodes(model.cloud);
  check_cells(model.cells);
  check_conditions(model.conditions, model.cloud.size());
  for (const auto& [label, material] : model.materials) {
    check_material("the material of label " + std::to_string(label), material);
  }
  if (!model.gravity.allFinite()) {
    throw std::invalid_argument("gravity is not finite; m/s² are expected");
  }
}

void check_model(const Model& model) {
  if (model.resection) {
    check_table(resection_options(), *model.resection);
    if (model.resection->fluid_level && !(model.resection->wall && model.fluid)) {
      throw std::invalid_argument(
          "the fluid in a cavity has a level, but " +
          std::string(model.fluid ? "the cavity has no wall that is a surface: give Resection::wall"
                                  : "nothing says which way gravity pulls it: give the gravity, and the level of the "
                                    "fluid about the brain"));
    }
  }
  check_plane(model);
  check_cloud(model.cloud);
}

void check_held(const OrderedCloud& cloud, Plane plane, bool contact, bool pushed) {
  // Rigid motions that are left free make the steady state undefined: three of a plane, x, y and the turn, else six.
  std::vector<Eigen::Matrix<double, 1, 6>> rows;
  const Eigen::RowVector3d centre = cloud.positions.colwise().mean();
  const double size = (cloud.positions.rowwise() - centre).cwiseAbs().maxCoeff();
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    const Eigen::Vector3d x = (cloud.positions.row(a) - centre) / size;
    const Eigen::Matrix<double, 3, 6> motions = rigid_motions_at(x);
    for (int axis = 0; axis < (plane == Plane::none ? 3 : 2); ++axis) {
      if (cloud.conditions.is_prescribed(a, axis)) {
        rows.push_back(motions.row(axis));
      }
    }
  }
  const Points inner = cloud.conditions.measured ? cloud.conditions.measured->inner : Points(0, 3);
  for (Eigen::Index i = 0; i < inner.rows(); ++i) {
    const Eigen::Vector3d x = (inner.row(i) - centre) / size;
    const Eigen::Matrix<double, 3, 6> row = rigid_motions_at(x);
    rows.insert(rows.end(), {row.row(0), row.row(1), row.row(2)});
  }
  if (rows.empty() && contact && pushed) {
    return;  // the skull holds it
  }
  if (rows.empty()) {
    throw std::invalid_argument(
        pushed ? "nothing holds the body: no displacement is prescribed, and there is no skull to stop it; hold "
                 "three nodes that are not in line, or add contact"
               : "nothing is prescribed: no node is loaded or held; give a load");
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

void check_held(const OrderedCloud& cloud, const Model& model) {
  check_held(cloud, model.plane, model.skull.has_value(), is_pushed(model, cloud.conditions.force));
}

void check_parts_held(const OrderedCloud& cloud, const ShapeRows& point_rows, const Model& model) {
  const std::vector<std::int32_t> part = parts_of(cloud.size(), point_rows);
  std::map<std::int32_t, std::vector<Eigen::Index>> nodes;
  for (std::size_t a = 0; a < part.size(); ++a) {
    nodes[part[a]].push_back(static_cast<Eigen::Index>(a));
  }
  if (nodes.size() == 1) {
    return;  // check_held() has asked that of it
  }
  const bool pushed = is_pushed(model, cloud.conditions.force);
  for (const auto& [root, members] : nodes) {
    OrderedCloud alone;
    alone.positions = cloud.positions(members, Eigen::all);
    if (cloud.conditions.displacement.rows() > 0) {
      alone.conditions.displacement = cloud.conditions.displacement(members, Eigen::all);
    }
    try {
      check_held(alone, model.plane, model.skull.has_value(), pushed);
    } catch (const std::invalid_argument& error) {
      const Eigen::RowVector3d middle = alone.positions.colwise().mean();
      std::ostringstream text;
      text << "the body is left in parts, and the part about (" << middle[0] << ", " << middle[1] << ", " << middle[2]
           << ") mm, of " << members.size() << " nodes, is not held: " << error.what();
      throw std::invalid_argument(text.str());
    }
  }
}

}  // namespace brainshift::solve
