// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/thinned_body.hpp"

#include <cmath>
#include <numeric>

#include "solve/cut/resection.hpp"
#include "solve/quadrature/cell_points.hpp"
#include "solve/quadrature/pressure_patches.hpp"
#include "solve/run/coarse.hpp"

namespace brainshift::solve {

namespace {

constexpr std::size_t most_nodes = 500;
constexpr double nodes_a_patch = 8;

std::vector<std::int32_t> chosen(const std::vector<std::int32_t>& nodes, const std::vector<std::int32_t>& rows) {
  std::vector<std::int32_t> some;
  for (const std::int32_t row : rows) {
    some.push_back(nodes[static_cast<std::size_t>(row)]);
  }
  return some;
}

/// Ordered; `original`: of the model's cloud.
OrderedCloud few_nodes(const Model& model) {
  NodeCloud cloud = model.cloud;
  Conditions conditions = model.conditions;
  std::vector<std::int32_t> original(cloud.size());
  std::iota(original.begin(), original.end(), 0);
  while (cloud.size() > most_nodes) {
    const std::vector<std::int32_t> nodes = coarse_nodes(cloud, conditions);
    if (nodes.size() >= cloud.size()) {
      break;
    }
    const double wider = std::cbrt(static_cast<double>(cloud.size()) / static_cast<double>(nodes.size()));
    cloud = subset(cloud, nodes);
    conditions = subset(conditions, nodes);
    original = chosen(original, nodes);
    for (double& spacing : cloud.spacing) {
      spacing *= wider;
    }
  }
  OrderedCloud ordered = order_nodes(cloud, conditions);
  ordered.original = chosen(original, ordered.original);
  return ordered;
}

}  // namespace

ThinnedBody thinned_body(const Model& model, const ShapeOptions& options) {
  BodyParts parts;
  parts.cloud = few_nodes(model);
  const ShapeFunctions shape(parts.cloud.positions, parts.cloud.spacing,
                             {.basis = Basis::linear, .derivatives = options.derivatives});
  const LabelMap* labels = model.labels ? &*model.labels : nullptr;
  parts.points = integration_points(model.cells, 1, labels, tissues_of(model));
  parts.point_rows = shape.evaluate(parts.points.positions, true);
  parts.materials = material_table(model.materials, parts.points.label);
  const double volume = std::accumulate(parts.points.volume.begin(), parts.points.volume.end(), 0.0);
  std::vector<double> share = parts.points.volume;
  for (double& s : share) {
    s *= static_cast<double>(parts.cloud.size()) / volume;
  }
  parts.patches = pressure_patches(parts.points.positions, share, parts.materials.row_of_point, nodes_a_patch);
  return {parts.cloud.original, stiff_body(parts, model.skull.has_value())};
}

}  // namespace brainshift::solve
