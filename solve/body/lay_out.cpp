// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/body/lay_out.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

#include "segmentation/geometry/branching_edges.hpp"
#include "segmentation/geometry/nearest_on_segment.hpp"
#include "segmentation/geometry/quantile.hpp"
#include "segmentation/geometry/surface_tree.hpp"
#include "solve/body/mass_in_time.hpp"
#include "solve/boundary/external_force.hpp"
#include "solve/boundary/fluid_force.hpp"
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
    add_fluid_force(fluid, model.materials, model.cells, parts.points, parts.point_rows, total);
  }
  return ExternalForce(std::move(at_levels));
}

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

/// Contact pushes nodes back before they are far out, so it is enough to know the distance near the skull; but where a
/// node starts farther out. Where nodes are near to each other, as in a small body, its samples are, too.
SignedDistance distance_for_contact(const Surface& skull, const OrderedCloud& cloud) {
  constexpr double from_node_to_node = 3, across = 200;  // steps of the grid: at the least, at the most
  SignedDistanceOptions all;
  const double wanted = std::max(median(cloud.spacing) / from_node_to_node, extent(skull) / across);
  const double finer = std::min(1.0, wanted / all.spacing);
  all.spacing *= finer;
  all.margin *= finer;
  SignedDistanceOptions near = all;
  near.far = false;
  near.margin -= 10 * near.spacing;  // whole steps: the samples lie where those of the full field do
  SignedDistance distance(skull, near);
  const std::vector<std::int32_t> nodes = free_surface_nodes(cloud, cloud.conditions);
  const bool far_out = std::any_of(nodes.begin(), nodes.end(), [&](std::int32_t a) {
    return distance.value(cloud.positions.row(a)) > near.band() - near.spacing;
  });
  return far_out ? SignedDistance(skull, all) : distance;
}

/// Whether a place is nearer than that, mm, to one of the edges of a surface.
bool is_near(const Eigen::Vector3d& x, double reach, const Surface& surface,
             const std::vector<std::array<std::int32_t, 2>>& edges) {
  return std::ranges::any_of(edges, [&](const auto& edge) {
    return (nearest_on_segment(x, surface.vertices.row(edge[0]), surface.vertices.row(edge[1])) - x).norm() < reach;
  });
}

/// Nodes of the surface, and those where sheets of the septum meet, which are on no face of it. One that something else
/// holds in all directions is none; one on a plane of symmetry slides along it.
std::vector<std::int32_t> nodes_at_septum(const Surface& septum, const OrderedCloud& cloud) {
  const std::vector<std::array<std::int32_t, 2>> branches = branching_edges(septum.triangles);
  std::vector<std::int32_t> nodes;
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    const auto k = static_cast<std::size_t>(a);
    if (cloud.on_surface[k] != 0 || is_near(cloud.positions.row(a), 0.5 * cloud.spacing[k], septum, branches)) {
      nodes.push_back(static_cast<std::int32_t>(a));
    }
  }
  std::erase_if(nodes, [&](std::int32_t a) { return cloud.conditions.is_held(a); });
  return nodes;
}

/// Surface nodes on the wall of a cavity.
std::vector<WallNode> nodes_at_wall(const Surface& wall, const OrderedCloud& cloud) {
  constexpr double on_wall = 1e-3;  // of the spacing
  const SurfaceTree tree(wall);
  std::vector<WallNode> nodes;
  for (const std::int32_t a : surface_nodes(cloud)) {
    const Eigen::Vector3d x = cloud.positions.row(a);
    const SurfacePlace foot = tree.nearest(x);
    if ((foot.position - x).norm() <= on_wall * cloud.spacing[static_cast<std::size_t>(a)]) {
      nodes.push_back({a, foot.normal});
    }
  }
  return nodes;
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
