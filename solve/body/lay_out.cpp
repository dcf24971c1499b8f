// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/body/lay_out.hpp"

#include <algorithm>

#include "solve/body/contact_nodes.hpp"
#include "solve/body/forces.hpp"
#include "solve/body/mass_in_time.hpp"
#include "solve/force/firmness.hpp"
#include "solve/force/stiffness_bound.hpp"
#include "solve/shape/too_few_nodes.hpp"

namespace brainshift::solve {

namespace {

/// A node that no integration point sees has no mass, and nothing would hold it.
void check_supported(const PointBlocks& blocks, const OrderedCloud& cloud) {
  for (std::size_t a = 0; a < blocks.nodes(); ++a) {
    if (blocks.node_begin[a] == blocks.node_begin[a + 1]) {
      throw TooFewNodes("node " + std::to_string(cloud.original[a]) +
                        " lies in the support of no integration point: the cells do not cover the cloud there, "
                        "or are too coarse for its spacing");
    }
  }
}

/// The laws as stepping needs them: at rest relaxed materials have relaxed.
PointLaws point_laws(const MaterialTable& table, Plane plane, Dynamics dynamics) {
  PointLaws laws;
  for (const Material& m : table.material) {
    laws.elastic.push_back(elastic_law(dynamics == Dynamics::relaxation ? long_term(m) : m));
  }
  for (const Material& m : table.material) {
    laws.swelling.push_back(m.swelling);
  }
  if (std::all_of(laws.swelling.begin(), laws.swelling.end(), [](double s) { return s == 0; })) {
    laws.swelling.clear();
  }
  laws.plane_stress = plane == Plane::stress;
  laws.in_time = dynamics == Dynamics::transient;
  return laws;
}

}  // namespace

PointLaws laws_with(const Body& body, const std::map<std::int32_t, Material>& materials) {
  MaterialTable table;
  for (const Patch& patch : body.points.patches) {
    const auto row = static_cast<std::size_t>(patch.material);
    if (row >= table.material.size()) {
      table.material.resize(row + 1);
    }
    table.material[row] = materials.at(body.placed.tissue[static_cast<std::size_t>(patch.first_point)]);
  }
  return point_laws(table, body.laws.plane_stress ? Plane::stress : Plane::none, Dynamics::relaxation);
}

namespace {

EssentialConditions essential_conditions(const SolveOptions& options, const BodyParts& parts) {
  const Conditions& conditions = parts.cloud.conditions;
  const Points& prescribed = conditions.displacement;
  if (conditions.measured) {
    return {prescribed, parts.nodal_rows, parts.cloud.original, *conditions.measured, parts.inner_rows, parts.rim};
  }
  return {prescribed, parts.nodal_rows, parts.cloud.original, options.imposition, parts.rim};
}

PlacedPoints in_order(const IntegrationPoints& points, const std::vector<std::int32_t>& order) {
  PlacedPoints placed{points.positions(order, Eigen::all), {}};
  for (const std::int32_t p : order) {
    placed.tissue.push_back(points.label[static_cast<std::size_t>(p)]);
  }
  return placed;
}

/// In spacings of the nodes: surface nodes farther from a septum than that do not come to touch it.
constexpr double septum_reach = 2;

/// The pairs by ordered numbers.
std::vector<FacePair> ordered(std::span<const FacePair> pairs, const std::vector<std::int32_t>& original) {
  std::vector<std::int32_t> number(original.size());
  for (std::size_t a = 0; a < original.size(); ++a) {
    number[static_cast<std::size_t>(original[a])] = static_cast<std::int32_t>(a);
  }
  std::vector<FacePair> result(pairs.begin(), pairs.end());
  for (FacePair& pair : result) {
    pair.above = number[static_cast<std::size_t>(pair.above)];
    pair.below = number[static_cast<std::size_t>(pair.below)];
  }
  return result;
}

}  // namespace

Body lay_out(const Model& model, const SolveOptions& options, const BodyParts& parts, LayOutExtras extras) {
  const OrderedCloud& cloud = parts.cloud;
  const bool in_time = options.dynamics == Dynamics::transient;
  PointBlocks blocks = point_blocks(parts.points, parts.point_rows, parts.materials.row_of_point, cloud.size(),
                                    parts.patches, options.precision);
  check_supported(blocks, cloud);
  PointLaws laws = point_laws(parts.materials, model.plane, options.dynamics);
  if (!in_time) {  // in time stiff nodes set the step, which is not to become shorter
    blocks.felt = felt_tissues(blocks, laws.elastic.size());
  }
  Body body{
      .original = cloud.original,
      .positions = in_original_order(cloud.positions, cloud.original),
      .spacing = in_original_order(cloud.spacing, cloud.original),
      .cut = std::move(extras.cut),
      .nodal_rows = parts.nodal_rows,
      .points = std::move(blocks),
      .placed = in_order(parts.points, parts.patches.order),
      .stiff_parts = parts.stiff_parts,
      .node_modulus = parts.node_modulus,
      .laws = std::move(laws),
      .prony = in_time ? parts.materials.prony : std::vector<std::vector<PronyTerm>>(),
      .mass = {},
      .essential = essential_conditions(options, parts),
      .contact = {},
      .face_contact = {},
      .wall_contact = {},
      .septum_contact = {},
      .external = external_force(model, parts, options.dynamics),
  };
  if (in_time) {
    body.mass = mass_in_time(parts);
  }
  body.essential.count_as_held(extras.held);
  if (model.skull) {
    body.contact.emplace(extras.skull
                             ? std::move(extras.skull)
                             : std::make_shared<const SignedDistance>(distance_for_contact(*model.skull, cloud)),
                         cloud.positions, free_surface_nodes(cloud, cloud.conditions), parts.nodal_rows);
  }
  if (model.face_contact && !model.cuts.empty()) {
    body.face_contact.emplace(ordered(extras.faces, cloud.original), cloud.positions, cloud.spacing, parts.nodal_rows);
  }
  if (model.resection && model.resection->wall) {
    body.wall_contact.emplace(nodes_at_wall(*model.resection->wall, cloud), cloud.positions, cloud.spacing,
                              parts.nodal_rows);
  }
  if (model.septum) {
    const double spacing = *std::max_element(cloud.spacing.begin(), cloud.spacing.end());
    body.septum_contact.emplace(model.septum->sheet, cloud.positions, nodes_at_septum(model.septum->sheet, cloud),
                                septum_reach * spacing, parts.nodal_rows);
  }
  return body;
}

}  // namespace brainshift::solve
