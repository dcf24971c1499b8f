// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cloud/boundary_nodes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "discretise/cloud/dart_grid.hpp"
#include "discretise/sizing/tissue_lookup.hpp"
#include "segmentation/geometry/point_tree.hpp"

namespace brainshift::discretise {
namespace {

constexpr double farthest_moved = 0.45, least_apart = 0.5;  // spacings
constexpr double smoothing_radius = 1.5;                    // voxels
constexpr std::size_t most_smoothed = 24;                   // faces about one

/// A node near a boundary.
struct Near {
  double distance;  ///< spacings
  Eigen::Index node;
  Eigen::Vector3d place;  ///< on the boundary
};

std::vector<Near> nodes_near(const Points& boundary, const SizingField& sizing, double spacing, const Points& nodes) {
  const PointTree tree(boundary);
  std::vector<Near> near;
  for (Eigen::Index node = 0; node < nodes.rows(); ++node) {
    const Eigen::Vector3d x = nodes.row(node);
    const auto [place, squared] = tree.nearest(x.data());
    const double distance = std::sqrt(squared) / (spacing * sizing.factor(x));
    if (distance < farthest_moved) {
      near.push_back({distance, node, boundary.row(static_cast<Eigen::Index>(place))});
    }
  }
  std::ranges::stable_sort(near, {}, &Near::distance);
  return near;
}

}  // namespace

Points smooth_tissue_boundary(const LabelMap* labels, const DiscretiseOptions& options) {
  if (labels == nullptr) {
    return Points(0, 3);
  }
  const Points faces = tissue_boundary(*labels, options.brain_labels, options.alike);
  if (faces.rows() == 0) {
    return faces;
  }
  const PointTree tree(faces);
  const double radius = smoothing_radius * labels->geometry.spacing.maxCoeff();
  Points smooth(faces.rows(), 3);
#pragma omp parallel for schedule(static)
  for (Eigen::Index face = 0; face < faces.rows(); ++face) {
    std::array<std::size_t, most_smoothed> index;
    std::array<double, most_smoothed> squared;
    const std::size_t found = tree.nearest(faces.row(face).data(), most_smoothed, index.data(), squared.data());
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    double count = 0;
    for (std::size_t k = 0; k < found && squared[k] <= radius * radius; ++k, ++count) {
      sum += faces.row(static_cast<Eigen::Index>(index[k]));
    }
    smooth.row(face) = sum / count;
  }
  return smooth;
}

std::size_t move_onto_boundary(const Points& boundary, const Points& fixed, const Scanlines& body,
                               const SizingField& sizing, double spacing, Points& nodes) {
  if (boundary.rows() == 0 || nodes.rows() == 0) {
    return 0;
  }
  Points all(nodes.rows() + fixed.rows(), 3);
  all << nodes, fixed;
  const Eigen::Vector3d low = all.colwise().minCoeff().cwiseMin(boundary.colwise().minCoeff());
  const Eigen::Vector3d high = all.colwise().maxCoeff().cwiseMax(boundary.colwise().maxCoeff());
  DartGrid taken(low, high, least_apart * spacing);
  for (const auto& node : fixed.rowwise()) {
    taken.accept(node.transpose());
  }
  std::vector<char> stays(static_cast<std::size_t>(nodes.rows()), 1);
  std::vector<Eigen::Vector3d> moved;
  for (const Near& near : nodes_near(boundary, sizing, spacing, nodes)) {
    if (!body.inside(near.place)) {
      continue;
    }
    stays[static_cast<std::size_t>(near.node)] = 0;
    if (taken.is_free(near.place, least_apart * spacing * sizing.factor(near.place))) {
      taken.accept(near.place);
      moved.push_back(near.place);
    }
  }
  Eigen::Index count = 0;
  for (const Eigen::Vector3d& place : moved) {
    all.row(count++) = place;
  }
  for (Eigen::Index node = 0; node < nodes.rows(); ++node) {
    if (stays[static_cast<std::size_t>(node)] != 0) {
      all.row(count++) = nodes.row(node);
    }
  }
  nodes = all.topRows(count);
  return moved.size();
}

}  // namespace brainshift::discretise
