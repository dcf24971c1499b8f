// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/lay_out.hpp"

#include <algorithm>
#include <stdexcept>

#include "solve/dynamics/stiffness_bound.hpp"

namespace brainshift::solve {

namespace {

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

/// Forces on the parameters under the full load, µN; empty when nothing pushes.
NodalVectors external_force(const Model& model, const OrderedCloud& cloud, const ShapeRows& nodal_rows,
                            const IntegrationPoints& points, const ShapeRows& point_rows) {
  const bool gravity = !model.gravity.isZero();
  if (cloud.force.rows() == 0 && !gravity && !model.body_force) {
    return {};
  }
  NodalVectors force(4 * cloud.original.size(), 0.0);
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

PlacedPoints in_order(const IntegrationPoints& points, const std::vector<std::int32_t>& order) {
  PlacedPoints placed{points.positions(order, Eigen::all), {}};
  for (const std::int32_t p : order) {
    placed.tissue.push_back(points.label[static_cast<std::size_t>(p)]);
  }
  return placed;
}

/// Contact pushes nodes back before they are far out, so it is enough to know the distance near the skull; but where a
/// node starts farther out.
SignedDistance distance_for_contact(const Surface& skull, const OrderedCloud& cloud) {
  SignedDistanceOptions near;
  near.far = false;
  near.margin -= 10 * near.spacing;  // whole steps: the samples lie where those of the full field do
  SignedDistance distance(skull, near);
  const std::vector<std::int32_t> nodes = free_surface_nodes(cloud);
  const bool far_out = std::any_of(nodes.begin(), nodes.end(), [&](std::int32_t a) {
    return distance.value(cloud.positions.row(a)) > near.band() - near.spacing;
  });
  return far_out ? SignedDistance(skull) : distance;
}

}  // namespace

Prepared lay_out(const Model& model, const SolveOptions& options, const Pieces& pieces, std::span<const FacePair> faces,
                 std::span<const std::int32_t> held, std::optional<SignedDistance> skull) {
  const auto& [cloud, nodal_rows, points, point_rows, patches, materials] = pieces;
  PointBlocks blocks =
      point_blocks(points, point_rows, materials.row_of_point, cloud.size(), patches, options.precision);
  check_supported(blocks, cloud);
  EssentialConditions essential(cloud.prescribed_displacement, nodal_rows, cloud.original, options.imposition);
  essential.count_as_held(held);
  std::optional<Contact> contact;
  if (model.skull) {
    contact.emplace(skull ? std::move(*skull) : distance_for_contact(*model.skull, cloud), cloud.positions,
                    free_surface_nodes(cloud), nodal_rows);
  }
  std::optional<FaceContact> face_contact;
  if (model.face_contact && !model.cuts.empty()) {
    face_contact.emplace(faces, cloud, nodal_rows);
  }
  const bool in_time = options.dynamics == Dynamics::transient;
  std::vector<double> mass = in_time ? physical_mass(blocks, materials.density) : std::vector<double>();
  return {cloud.original,
          nodal_rows,
          std::move(blocks),
          in_order(points, patches.order),
          point_laws(materials, model.plane, options.dynamics),
          in_time ? materials.prony : std::vector<std::vector<PronyTerm>>(),
          std::move(mass),
          std::move(essential),
          std::move(contact),
          std::move(face_contact),
          external_force(model, cloud, nodal_rows, points, point_rows),
          {},
          {},
          {}};
}

}  // namespace brainshift::solve
