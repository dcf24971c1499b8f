// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/thin_parts.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string>

#include "segmentation/geometry/point_tree.hpp"
#include "solve/body/check_model.hpp"
#include "solve/body/ordered_cloud.hpp"

namespace brainshift::solve {

namespace {

constexpr double enough = 4;  // spacings

double mean_spacing_at(const NodeCloud& cloud, const std::vector<std::int32_t>& nodes) {
  double sum = 0;
  for (const std::int32_t a : nodes) {
    sum += cloud.spacing[static_cast<std::size_t>(a)];
  }
  return sum / static_cast<double>(nodes.size());
}

/// Of surface nodes, along the narrow side of their patch. Of n nodes in a row, evenly, the variance is (n² − 1) / 12
/// of the squared spacing.
double patch_across(const Model& model, const std::vector<std::int32_t>& nodes) {
  Points places = model.cloud.positions(nodes, Eigen::all);
  places.rowwise() -= places.colwise().mean().eval();
  const Eigen::Matrix3d spread = places.transpose() * places / static_cast<double>(nodes.size());
  const Eigen::Vector3d variance = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvalues();
  const double spacing = mean_spacing_at(model.cloud, nodes);
  const double narrow = model.plane == Plane::none ? variance[1] : variance[2];
  return std::sqrt(12 * std::max(0.0, narrow) / (spacing * spacing) + 1) - 1;
}

/// The patch through which the load comes: what is moved, or where forces alone act what is held against them.
std::optional<ThinPart> patch_of(const Model& model) {
  std::vector<std::int32_t> moved, held;
  for (Eigen::Index a = 0; a < model.conditions.displacement.rows(); ++a) {
    const auto u = model.conditions.displacement.row(a).array();
    if (model.cloud.on_surface[static_cast<std::size_t>(a)] != 0 && !u.isNaN().all()) {
      ((u.abs() > 0).any() ? moved : held).push_back(static_cast<std::int32_t>(a));
    }
  }
  if (!moved.empty()) {
    return ThinPart{.what = "the moved patch", .spacings = patch_across(model, moved)};
  }
  if (!held.empty() && is_pushed(model) && !model.skull) {
    return ThinPart{.what = "the held patch", .spacings = patch_across(model, held)};
  }
  return std::nullopt;
}

/// Twice the farthest that a point of a tissue lies from other tissue and from the surface, in spacings of the nodes
/// there.
double across(const PlacedPoints& points, std::int32_t tissue, const Points& surface, const NodeCloud& cloud,
              const PointTree& nodes) {
  std::vector<Eigen::Index> inside, outside;
  for (Eigen::Index p = 0; p < points.position.rows(); ++p) {
    (points.tissue[static_cast<std::size_t>(p)] == tissue ? inside : outside).push_back(p);
  }
  Points around(surface.rows() + static_cast<Eigen::Index>(outside.size()), 3);
  around << surface, points.position(outside, Eigen::all);
  if (around.rows() == 0) {
    return std::numeric_limits<double>::infinity();
  }
  const PointTree tree(around);
  double farthest = 0;
#pragma omp parallel for reduction(max : farthest)
  for (const Eigen::Index p : inside) {
    const Eigen::RowVector3d x = points.position.row(p);
    const double spacing = cloud.spacing[nodes.nearest(x.data()).first];
    farthest = std::max(farthest, std::sqrt(tree.nearest(x.data()).second) / spacing);
  }
  return 2 * farthest;
}

}  // namespace

std::vector<ThinPart> thin_parts(const Model& model, const PlacedPoints& points) {
  std::vector<ThinPart> thin;
  if (const std::optional<ThinPart> patch = patch_of(model); patch && patch->spacings < enough) {
    thin.push_back(*patch);
  }
  const Points surface = model.cloud.positions(surface_nodes(model.cloud), Eigen::all);
  const PointTree nodes(model.cloud.positions);
  for (const std::int32_t tissue : std::set<std::int32_t>(points.tissue.begin(), points.tissue.end())) {
    if (const double spacings = across(points, tissue, surface, model.cloud, nodes); spacings < enough) {
      thin.push_back({.what = "tissue " + std::to_string(tissue), .spacings = spacings, .is_tissue = true});
    }
  }
  return thin;
}

}  // namespace brainshift::solve
