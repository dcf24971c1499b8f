// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/prepare.hpp"

#include <algorithm>
#include <stdexcept>

#include "solve/body/check_discretisation.hpp"
#include "solve/body/check_model.hpp"
#include "solve/body/lay_out.hpp"
#include "solve/body/soft_nodes.hpp"
#include "solve/body/stiff_parts.hpp"
#include "solve/boundary/patch_rim.hpp"
#include "solve/cut/boundary_normals.hpp"
#include "solve/cut/cut_patches.hpp"
#include "solve/cut/resection.hpp"
#include "solve/measured/inner_rows.hpp"
#include "solve/quadrature/adaptive_points.hpp"
#include "solve/quadrature/cell_points.hpp"
#include "solve/quadrature/missing_octants.hpp"
#include "solve/quadrature/pressure_patches.hpp"
#include "solve/shape/consistent_derivatives.hpp"

namespace brainshift::solve {

namespace {

/// The nodes that each integration point stands for: its volume over that of a node there, scaled to their number.
std::vector<double> nodes_per_point(const IntegrationPoints& points, const ShapeRows& rows,
                                    std::span<const double> spacing, bool planar) {
  std::vector<double> share(points.size());
  double total = 0;
  for (std::size_t p = 0; p < share.size(); ++p) {
    double of_node = 0;
    const std::span<const std::int32_t> support = rows[p].node;
    for (const std::int32_t node : support) {
      const double s = spacing[static_cast<std::size_t>(node)];
      of_node += (planar ? s * s : s * s * s) / static_cast<double>(support.size());
    }
    share[p] = points.volume[p] / of_node;
    total += share[p];
  }
  for (double& s : share) {
    s *= static_cast<double>(spacing.size()) / total;
  }
  return share;
}

AdaptivePoints place_points(const Model& model, const BackgroundCells& cells, const ShapeFunctions& shape,
                            const SolveOptions& options) {
  const LabelMap* labels = model.labels ? &*model.labels : nullptr;
  const std::vector<std::int32_t> tissues = tissues_of(model);
  const bool adaptive = options.integration_tolerance > 0;
  const int per_cell = points_per_cell(options.points_per_cell, cells.kind, adaptive);
  if (adaptive) {
    const AdaptiveRule rule{options.integration_tolerance, options.integration_depth, per_cell};
    return adaptive_points(cells, shape, rule, labels, tissues);
  }
  AdaptivePoints plain{integration_points(cells, per_cell, labels, tissues), {}};
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
  constexpr double one = 1;
  ShapeRows result;
  auto next = pinned.begin();
  for (std::size_t a = 0; a < rows.size(); ++a) {
    if (next != pinned.end() && *next == static_cast<std::int32_t>(a)) {
      result.append({std::span(&*next++, 1), std::span(&one, 1), {}});
    } else {
      result.append(rows[a]);
    }
  }
  return result;
}

void measure_sizes(const BodyParts& parts, std::size_t capped, SolveMeasures& m) {
  m.nodes = parts.cloud.size();
  m.integration_points = parts.points.size();
  m.capped_points = capped;
  m.pairs = parts.point_rows.node.size();
  m.mean_support = static_cast<double>(m.pairs) / static_cast<double>(m.integration_points);
  m.grown_supports = parts.point_rows.grown;
  m.outside_label = parts.points.labelled_by_cell;
  m.loaded_nodes = count_loaded(parts.cloud.conditions);
}

/// Within each patch by the nodes that points see: the processor foresees how long the loop over them is.
void order_by_support(const ShapeRows& rows, PressurePatches& patches) {
  const auto size = [&](std::int32_t p) { return rows[static_cast<std::size_t>(p)].size(); };
  for (std::size_t i = 0; i < patches.size(); ++i) {
    std::stable_sort(patches.order.begin() + patches.begin[i], patches.order.begin() + patches.begin[i + 1],
                     [&](std::int32_t a, std::int32_t b) { return size(a) < size(b); });
  }
}

PressurePatches patches_of(const Model& model, const SolveOptions& options, const BodyParts& parts,
                           const Visibility* visibility) {
  const bool shared_pressure = options.volumetric == Volumetric::mean_dilatation && model.plane != Plane::stress;
  PressurePatches patches =
      pressure_patches(parts.points.positions,
                       nodes_per_point(parts.points, parts.point_rows, parts.cloud.spacing, options.shape.planar),
                       parts.materials.row_of_point, shared_pressure ? options.nodes_per_patch : 0);
  if (visibility != nullptr && shared_pressure) {
    patches = part_patches(*visibility, parts.points.positions, patches);
  }
  order_by_support(parts.point_rows, patches);
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

/// Of a cavity with a wall that something presses in.
std::optional<WallLoad> wall_load(const Model& model, const ShapeFunctions& shape) {
  constexpr double piece = 0.5;  // of the spacing
  if (!model.resection || !presses_on_wall(*model.resection)) {
    return std::nullopt;
  }
  WallLoad load{forces_on_wall(*model.resection->wall, piece * mean_spacing(model.cloud), cavity_pressure(model)), {}};
  load.rows = shape.evaluate(load.forces.places, false);
  return load;
}

bool cuts_go_on(const Model& model) {
  return last_time(model.cuts) > 0 || model.rupture;
}

/// One a node: whether its displacement is prescribed.
std::vector<std::uint8_t> held_nodes(const OrderedCloud& cloud) {
  std::vector<std::uint8_t> held;
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    held.push_back(cloud.conditions.is_prescribed(a) ? 1 : 0);
  }
  return held;
}

/// Tissue sees no nodes in tissue that is much softer. Where cuts go on all are seen, as rows come and go there. Notes
/// the stiff parts.
void part_by_stiffness(const Model& model, const SolveOptions& options, std::shared_ptr<const Visibility> visibility,
                       BodyParts& parts) {
  const auto& contrast = model.contrast.empty() ? model.materials : model.contrast;
  std::vector<double> of_point;
  for (const std::int32_t label : parts.points.label) {
    of_point.push_back(shear_modulus(contrast.at(label)));
  }
  const auto [softest, stiffest] = std::ranges::minmax(of_point);
  if (!much_stiffer(stiffest, softest) || cuts_go_on(model)) {
    return;
  }
  parts.node_modulus = moduli_at_nodes(parts.points.volume, of_point, parts.point_rows, parts.cloud.size());
  const MixedCloud cloud{parts.cloud.positions, parts.cloud.spacing, options.shape, std::move(visibility),
                         parts.node_modulus};
  hide_soft_nodes(cloud, parts.points.positions, of_point, parts.point_rows);
  hide_soft_nodes(cloud, parts.cloud.positions, parts.node_modulus, parts.nodal_rows);
  parts.stiff_parts = stiff_parts(of_point, parts.node_modulus, parts.point_rows, held_nodes(parts.cloud));
}

/// Where a patch of what is prescribed ends. None in a plane, where the surface is a line, where cuts go on, as rows
/// come and go there, and for the simplified form, which errs the other way.
PatchRim rim_of(const Model& model, const SolveOptions& options, std::shared_ptr<const Visibility> visibility,
                std::span<const std::int32_t> held, const BodyParts& parts) {
  const OrderedCloud& cloud = parts.cloud;
  const bool at_nodes = cloud.conditions.at_nodes_alone || options.imposition != Imposition::exact;
  if (at_nodes || model.plane != Plane::none || cuts_go_on(model)) {
    return {};
  }
  PatchRim rim = patch_rim(cloud, cloud.conditions.displacement, held, visibility.get());
  rim.rows =
      rows_at_rim({cloud.positions, cloud.spacing, options.shape, std::move(visibility), parts.node_modulus}, rim);
  return rim;
}

/// Of the derivatives at the integration points. whole: the body is no region, whose wall is unknown. Returns how many
/// iterations that took.
int make_consistent(const Model& model, const SolveOptions& options, const std::optional<CutBody>& cut, bool whole,
                    BodyParts& parts) {
  std::optional<SurfaceNormals> normals;
  if (whole) {
    normals = boundary_normals(known_boundary(model), cut ? cut->facets() : CutFacets(), parts.cloud, parts.nodal_rows);
  }
  return make_derivatives_consistent(parts.cloud.positions, surface_nodes(parts.cloud), parts.nodal_rows,
                                     parts.points.volume, options.consistency_defect, parts.point_rows, {},
                                     normals ? &*normals : nullptr)
      .iterations;
}

/// The body where it is cut or has a septum, as at the start.
std::optional<CutBody> parted(const Model& model) {
  if (model.cuts.empty() && !model.rupture && !model.septum) {
    return std::nullopt;
  }
  return cut_body(model);
}

/// Shape functions at the nodes and at all places that are no integration points. held: pinned_nodes().
void evaluate_at_places(const Model& model, const ShapeFunctions& shape, std::span<const std::int32_t> held,
                        BodyParts& parts) {
  parts.nodal_rows = shape.evaluate(parts.cloud.positions, false);
  if (!held.empty()) {
    parts.nodal_rows = with_pinned(parts.nodal_rows, held);
  }
  if (parts.cloud.conditions.measured) {
    parts.inner_rows = inner_rows(shape, parts.cloud.conditions.measured->inner);
  }
  parts.wall_load = wall_load(model, shape);
}

/// The integration points that a resection leaves.
AdaptivePoints points_of_rest(const Model& model, const ShapeFunctions& shape, const SolveOptions& options) {
  const std::optional<BackgroundCells> completed = with_missing_octants(model.cells, model.boundary, model.cloud);
  AdaptivePoints placed = place_points(model, completed ? *completed : model.cells, shape, options);
  if (model.resection) {
    leave_out(*model.resection, placed);
  }
  return placed;
}

/// Of a body that comes to rest and may be in parts. A face of a cut may hold the other.
void check_parts(const Model& model, const OrderedCloud& cloud, const ShapeRows& point_rows, bool is_parted) {
  const bool may_part = is_parted || model.resection || (is_pushed(model) && !model.skull);
  if (may_part && !model.face_contact) {
    check_parts_held(cloud, point_rows, model);
  }
}

}  // namespace

Prepared prepare(const Model& model, const SolveOptions& options, std::span<const std::uint8_t> pinned,
                 SolveMeasures& measures, const Progress& progress, bool keep_parts) {
  check_model(model);
  check_rupture(model, options.dynamics);
  std::optional<CutBody> cut = parted(model);
  const std::shared_ptr<const Visibility> visibility = cut ? cut->visibility : nullptr;
  BodyParts parts;
  parts.cloud = order_nodes(cut ? cut->cloud : model.cloud, cut ? cut->conditions : model.conditions);
  if (options.dynamics == Dynamics::relaxation) {
    check_held(parts.cloud, model);
  }
  report(progress, 0, "evaluating shape functions");
  const ShapeFunctions shape(parts.cloud.positions, parts.cloud.spacing, options.shape, visibility);
  const std::vector<std::int32_t> held = pinned_nodes(parts.cloud, pinned);
  evaluate_at_places(model, shape, held, parts);
  AdaptivePoints placed = points_of_rest(model, shape, options);
  if (options.dynamics == Dynamics::relaxation) {
    check_parts(model, parts.cloud, placed.rows, visibility != nullptr);
  }
  parts.points = std::move(placed.points);
  parts.point_rows = std::move(placed.rows);
  measures.fewest_points = check_points(parts.cloud, parts.points, parts.point_rows, parts.nodal_rows);
  parts.materials = material_table(model.materials, parts.points.label);
  part_by_stiffness(model, options, visibility, parts);
  parts.rim = rim_of(model, options, visibility, held, parts);
  measure_sizes(parts, placed.capped, measures);
  measures.single_precision = options.precision == Precision::single_precision;
  if (options.integration == Integration::consistent) {
    measures.consistency_iterations = make_consistent(model, options, cut, pinned.empty(), parts);
  }
  parts.patches = patches_of(model, options, parts, visibility.get());
  LayOutExtras extras{.cut = {}, .faces = {}, .held = held, .skull = {}};
  if (cut) {
    extras.cut = cut->facets();
    extras.faces = cut->cut_pairs();
  }
  Prepared prepared{.body = lay_out(model, options, parts, std::move(extras)), .cut = std::move(cut), .parts = {}};
  if (keep_parts || cuts_go_on(model)) {
    prepared.parts = std::move(parts);
  }
  return prepared;
}

}  // namespace brainshift::solve
