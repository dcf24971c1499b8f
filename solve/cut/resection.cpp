// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/resection.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "segmentation/geometry/point_tree.hpp"
#include "solve/body/ordered_cloud.hpp"
#include "solve/cut/cavity_pressure.hpp"
#include "solve/quadrature/cell_points.hpp"
#include "solve/quadrature/taken_cells.hpp"

namespace brainshift::solve {

namespace {

/// How far from what is left, over its spacing, a node stays: nodes further out would be seen so little that their
/// parameters run wild, and with none outside the wall is too stiff.
constexpr double stays_within = 0.75;

/// One a point: 1 where its tissue is taken out.
std::vector<std::uint8_t> removed_points(const IntegrationPoints& points, const Resection& resection) {
  std::vector<std::uint8_t> removed;
  for (const std::int32_t label : points.label) {
    removed.push_back(std::ranges::find(resection.labels, label) != resection.labels.end() ? 1 : 0);
  }
  return removed;
}

std::vector<std::int32_t> indices_of(std::span<const std::uint8_t> marks, std::uint8_t which) {
  std::vector<std::int32_t> indices;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i] == which) {
      indices.push_back(static_cast<std::int32_t>(i));
    }
  }
  return indices;
}

void check_labels(const IntegrationPoints& points, const Resection& resection, std::span<const std::uint8_t> removed) {
  for (const std::int32_t label : resection.labels) {
    if (std::ranges::find(points.label, label) == points.label.end()) {
      throw std::invalid_argument("the resection takes out label " + std::to_string(label) +
                                  ", which no integration point of the body has");
    }
  }
  if (std::ranges::count(removed, 0) == 0) {
    throw std::invalid_argument("the resection takes out the whole body; leave a tissue");
  }
  if (std::ranges::count(removed, 1) == 0) {
    throw std::invalid_argument("the resection names no label");
  }
}

/// Nodes by what becomes of them.
struct Nodes {
  std::vector<std::uint8_t> stays;    ///< one a node
  std::vector<std::uint8_t> at_wall;  ///< one a node
};

Nodes choose_nodes(const NodeCloud& cloud, const Points& left, const Points& removed) {
  const PointTree tree_left(left), tree_removed(removed);
  Nodes nodes;
  for (std::size_t a = 0; a < cloud.size(); ++a) {
    const double* x = cloud.positions.row(static_cast<Eigen::Index>(a)).data();
    const double to_left = std::sqrt(tree_left.nearest(x).second);
    const double to_removed = std::sqrt(tree_removed.nearest(x).second);
    nodes.stays.push_back(to_left <= std::max(stays_within * cloud.spacing[a], to_removed) ? 1 : 0);
    nodes.at_wall.push_back(to_removed <= std::max(cloud.spacing[a], to_left) ? 1 : 0);
  }
  return nodes;
}

/// Those with points that go and none that stays are gone.
BackgroundCells cells_left(const BackgroundCells& cells, const IntegrationPoints& points,
                           std::span<const std::uint8_t> removed) {
  std::vector<std::uint8_t> gone(cells.size(), 0);
  for (std::size_t i = 0; i < removed.size(); ++i) {
    gone[static_cast<std::size_t>(points.cell[i])] |= removed[i];
  }
  for (std::size_t i = 0; i < removed.size(); ++i) {
    gone[static_cast<std::size_t>(points.cell[i])] &= removed[i];
  }
  return taken_cells(cells, gone, 0);
}

/// Adds the force that a pressure in the cavity has at the nodes that stay; what little falls to the others acts at
/// the nearest of them.
void add_pressure(const Points& force, const std::vector<std::int32_t>& stay, const std::vector<std::int32_t>& gone,
                  const Points& all, Points& total) {
  const Points places = all(stay, Eigen::all);
  if (total.rows() == 0) {
    total = Points::Zero(places.rows(), 3);
  }
  total += force(stay, Eigen::all);
  const PointTree tree(places);
  for (const std::int32_t a : gone) {
    const auto nearest = static_cast<Eigen::Index>(tree.nearest(all.row(a).data()).first);
    total.row(nearest) += force.row(a);
  }
}

}  // namespace

Resected resect(const Model& model, const SolveOptions& options) {
  const Resection& resection = *model.resection;
  if (resection.wall) {
    return resect_within_wall(model);
  }
  const bool adaptive = options.integration_tolerance > 0;
  const IntegrationPoints points = integration_points(
      model.cells, points_per_cell(adaptive ? std::nullopt : options.points_per_cell, model.cells.kind, false),
      model.labels ? &*model.labels : nullptr, tissues_of(model));
  const std::vector<std::uint8_t> removed = removed_points(points, resection);
  check_labels(points, resection, removed);
  const std::vector<std::int32_t> points_gone = indices_of(removed, 1);
  const Nodes nodes = choose_nodes(model.cloud, points.positions(indices_of(removed, 0), Eigen::all),
                                   points.positions(points_gone, Eigen::all));
  const std::vector<std::int32_t> stay = indices_of(nodes.stays, 1), gone = indices_of(nodes.stays, 0);
  check_free(model, gone);
  Resected result{model, {gone.size(), 0}};
  for (const std::int32_t point : points_gone) {
    result.measures.removed_volume += points.volume[static_cast<std::size_t>(point)];
  }
  NodeCloud& cloud = result.rest.cloud;
  cloud = subset(model.cloud, stay);
  result.rest.conditions = subset(model.conditions, stay);
  for (std::size_t i = 0; i < stay.size(); ++i) {
    cloud.on_surface[i] |= nodes.at_wall[static_cast<std::size_t>(stay[i])];
  }
  result.rest.cells = cells_left(model.cells, points, removed);
  if (resection.pressure != 0) {
    const ShapeFunctions shape(model.cloud.positions, model.cloud.spacing, options.shape);
    const Points force = cavity_force(points, removed, shape.evaluate(points.positions, true),
                                      model.cloud.positions.rows(), resection.pressure);
    add_pressure(force, stay, gone, model.cloud.positions, result.rest.conditions.force);
  }
  return result;
}

void leave_out(const Resection& resection, AdaptivePoints& placed) {
  if (resection.wall) {
    return;
  }
  const std::vector<std::int32_t> left = indices_of(removed_points(placed.points, resection), 0);
  IntegrationPoints points{.positions = placed.points.positions(left, Eigen::all),
                           .volume = {},
                           .cell = {},
                           .label = {},
                           .labelled_by_cell = placed.points.labelled_by_cell};
  for (const std::int32_t point : left) {
    const auto i = static_cast<std::size_t>(point);
    points.volume.push_back(placed.points.volume[i]);
    points.cell.push_back(placed.points.cell[i]);
    points.label.push_back(placed.points.label[i]);
  }
  placed.points = std::move(points);
  const std::size_t grown = std::min(placed.rows.grown, left.size());  // those taken out may have grown, too
  placed.rows = rows_at(placed.rows, left);
  placed.rows.grown = grown;
}

std::vector<std::int32_t> tissues_of(const Model& model) {
  std::vector<std::int32_t> tissues;
  const auto is_taken = [&](std::int32_t label) {
    return model.resection && std::ranges::find(model.resection->labels, label) != model.resection->labels.end();
  };
  for (const auto& [label, material] : model.materials) {
    if (!is_taken(label)) {
      tissues.push_back(label);
    }
  }
  if (model.resection && !model.resection->wall) {
    tissues.insert(tissues.end(), model.resection->labels.begin(), model.resection->labels.end());
  }
  return tissues;
}

}  // namespace brainshift::solve
