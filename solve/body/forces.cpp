// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/body/forces.hpp"

#include <limits>
#include <utility>
#include <vector>

#include "solve/body/mass_in_time.hpp"
#include "solve/boundary/fluid_force.hpp"

namespace brainshift::solve {

namespace {

/// In time gravity pulls the masses that move, so that a free body falls as one; to rest it is spread by the shape
/// functions.
void add_weight(const Model& model, const BodyParts& parts, Dynamics dynamics, NodalVectors& force) {
  if (dynamics == Dynamics::transient) {
    constexpr double from_metres = 1000;
    const std::vector<double> mass = mass_in_time(parts);
    for (std::size_t a = 0; a < mass.size(); ++a) {
      at(force, a).head<3>() += from_metres * mass[a] * model.gravity;
    }
    return;
  }
  constexpr double per_cubic_millimetre = 1e-9;  // kg/m³ m/s² to N/mm³
  add_body_force(
      [&](const Eigen::Vector3d&, std::int32_t label) -> Eigen::Vector3d {
        return per_cubic_millimetre * model.materials.at(label).density * model.gravity;
      },
      parts.points, parts.point_rows, force);
}

/// Forces on the parameters under the full load, µN, without the fluid's; empty when nothing pushes.
NodalVectors full_force(const Model& model, const BodyParts& parts, Dynamics dynamics) {
  const bool gravity = !model.gravity.isZero();
  const Points& at_nodes = parts.cloud.conditions.force;
  if (at_nodes.rows() == 0 && !gravity && !model.body_force && !parts.wall_load) {
    return {};
  }
  NodalVectors force(4 * parts.cloud.size(), 0.0);
  if (at_nodes.rows() > 0) {
    add_point_forces(at_nodes, parts.nodal_rows, force);
  }
  if (parts.wall_load) {
    add_point_forces(parts.wall_load->forces.force, parts.wall_load->rows, force);
  }
  if (gravity) {
    add_weight(model, parts, dynamics, force);
  }
  if (model.body_force) {
    add_body_force(model.body_force, parts.points, parts.point_rows, force);
  }
  return force;
}

}  // namespace

ExternalForce external_force(const Model& model, const BodyParts& parts, Dynamics dynamics) {
  NodalVectors force = full_force(model, parts, dynamics);
  if (!model.fluid) {
    return ExternalForce(std::move(force));
  }
  force.resize(4 * parts.cloud.size(), 0.0);
  constexpr int levels_in_time = 32;
  const int levels = dynamics == Dynamics::transient ? levels_in_time : 1;
  const double top = highest(model.fluid->gravity, parts.cloud.positions);
  const PointExtents extents = extents_along(model.fluid->gravity.normalized(), model.cells, parts.points);
  std::vector<NodalVectors> at_levels;
  for (int k = 1; k <= levels; ++k) {
    const double fraction = static_cast<double>(k) / levels;
    DrainedFluid fluid = *model.fluid;
    // A covered body stays covered: of what points at the surface stand for, taken for boxes, a part may be above the
    // top.
    const bool covered = fluid.level <= top;
    fluid.level = covered ? -std::numeric_limits<double>::infinity() : top + fraction * (fluid.level - top);
    fluid.gravity_of_image = fluid.gravity + fraction * (fluid.gravity_of_image - fluid.gravity);
    NodalVectors& total = at_levels.emplace_back(force);
    for (double& f : total) {
      f *= fraction;
    }
    add_fluid_force(fluid, model.materials, parts.points, extents, parts.point_rows, total);
  }
  return ExternalForce(std::move(at_levels));
}

}  // namespace brainshift::solve
