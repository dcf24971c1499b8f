// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/noisy_load.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "segmentation/geometry/point_tree.hpp"
#include "solve/load/best_fit_plane.hpp"
#include "solve/load/joined_points.hpp"
#include "solve/load/near_surface.hpp"
#include "solve/load/openings.hpp"
#include "solve/load/spread_out.hpp"

namespace brainshift::solve {

namespace {

/// Depth below the surface about the nearest surface nodes, along the normal of their plane; negative outside.
double depth_below(const Points& rim, const PointTree& tree, const Eigen::RowVector3d& middle,
                   const Eigen::RowVector3d& x) {
  std::array<std::size_t, 7> row{};
  std::array<double, 7> squared{};
  const std::size_t count = tree.nearest(x.data(), row.size(), row.data(), squared.data());
  Points near(static_cast<Eigen::Index>(count), 3);
  for (std::size_t i = 0; i < count; ++i) {
    near.row(static_cast<Eigen::Index>(i)) = rim.row(static_cast<Eigen::Index>(row[i]));
  }
  const Plane3 plane = best_fit_plane(near);
  Eigen::RowVector3d outward = plane.axes.col(2).transpose();
  outward *= outward.dot(plane.origin - middle) < 0 ? -1 : 1;
  return (plane.origin - x).dot(outward);
}

/// The share of each point of the cortex in what is prescribed at each node: what becomes of a displacement of 1 mm of
/// this point alone, three points at once. The limits of the extension would let shares near the rim sum to less or
/// more than one; then not even what moves alike would.
Eigen::SparseMatrix<double> shares(const NodeCloud& cloud, const CraniotomyLoad& cortex,
                                   const OpeningOptions& options) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index first = 0; first < cortex.positions.rows(); first += 3) {
    CraniotomyLoad unit{cortex.positions, Points::Zero(cortex.positions.rows(), 3), {}};
    for (Eigen::Index k = 0; k < std::min<Eigen::Index>(3, cortex.positions.rows() - first); ++k) {
      unit.displacement(first + k, k) = 1;
    }
    const Points share = prescribed_on_surface_nodes(cloud, unit, options);
    for (Eigen::Index a = 0; a < share.rows(); ++a) {
      for (Eigen::Index k = 0; k < std::min<Eigen::Index>(3, cortex.positions.rows() - first); ++k) {
        if (!std::isnan(share(a, k)) && share(a, k) != 0) {
          entries.emplace_back(static_cast<int>(a), static_cast<int>(first + k), share(a, k));
        }
      }
    }
  }
  Eigen::SparseMatrix<double> spread(cloud.positions.rows(), cortex.positions.rows());
  spread.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd sum = spread * Eigen::VectorXd::Ones(spread.cols());
  return (sum.array() == 0).select(1, sum).cwiseInverse().asDiagonal() * spread;
}

/// What each node has of the faults of some others: Shepard's weights of the four nearest (Shepard 1968).
Eigen::SparseMatrix<double> shares_of_nearest(const Points& positions, const std::vector<Eigen::Index>& nodes,
                                              const std::vector<Eigen::Index>& measured) {
  const Points places = positions(measured, Eigen::all);
  const PointTree tree(places);
  std::vector<Eigen::Triplet<double>> entries;
  for (const Eigen::Index node : nodes) {
    std::array<std::size_t, 4> row{};
    std::array<double, 4> squared{};
    const Eigen::RowVector3d x = positions.row(node);
    std::size_t count = tree.nearest(x.data(), row.size(), row.data(), squared.data());
    if (squared[0] == 0) {
      count = 1;
      squared[0] = 1;
    }
    double total = 0;
    for (std::size_t i = 0; i < count; ++i) {
      total += 1 / squared[i];
    }
    for (std::size_t i = 0; i < count; ++i) {
      entries.emplace_back(static_cast<int>(node), static_cast<int>(row[i]), 1 / squared[i] / total);
    }
  }
  Eigen::SparseMatrix<double> spread(positions.rows(), static_cast<Eigen::Index>(measured.size()));
  spread.setFromTriplets(entries.begin(), entries.end());
  return spread;
}

}  // namespace

std::vector<Eigen::Index> inner_points(const NodeCloud& cloud, const CraniotomyLoad& load) {
  const std::vector<std::int32_t> surface = surface_nodes(cloud);
  const Points rim = cloud.positions(surface, Eigen::all);
  const PointTree nodes(cloud.positions), outer(rim);
  const Eigen::RowVector3d middle = cloud.positions.colwise().mean();
  std::vector<Eigen::Index> inner;
  for (Eigen::Index p = 0; p < load.positions.rows() && !surface.empty(); ++p) {
    const Eigen::RowVector3d x = load.positions.row(p);
    if (!x.allFinite()) {
      continue;  // check_load() refuses it
    }
    const auto [near, squared] = nodes.nearest(x.data());
    const bool in_cloud = std::sqrt(squared) <= 1.5 * cloud.spacing[near];
    const auto [nearest, of_surface] = outer.nearest(x.data());
    // So far from all nodes of the surface the nearest of these may lie all around, and tell no plane.
    const double farthest = std::hypot(cortex_depth, cloud.spacing[static_cast<std::size_t>(surface[nearest])]);
    const bool deep = cloud.on_surface[near] == 0 && std::sqrt(of_surface) > farthest;
    if (in_cloud && (deep || depth_below(rim, outer, middle, x) > cortex_depth)) {
      inner.push_back(p);
    }
  }
  return inner;
}

Conditions noisy_conditions(const NodeCloud& cloud, const CraniotomyLoad& load, const OpeningOptions& options) {
  check_load(load);
  if (load.sigma.rows() != load.positions.rows() || !(load.sigma.array() >= smallest_noise).all()) {
    throw std::invalid_argument("load: each measured point needs a standard deviation of 0.000001 mm or more");
  }
  const std::vector<Eigen::Index> inside = inner_points(cloud, load);
  const std::vector<Eigen::Index> outside = rows_but(inside, load.positions.rows());
  if (const std::vector<std::int32_t> nodes = surface_nodes(cloud); !nodes.empty()) {
    const Points surface = cloud.positions(nodes, Eigen::all);
    check_frame(load.positions, surface, options.farthest);
    if (!outside.empty()) {
      check_near_surface(load.positions(outside, Eigen::all), surface, options.farthest, outside,
                         load.positions.rows());
    }
    check_no_places(load);
    check_moved(load.displacement, surface);
  }
  Conditions conditions;
  conditions.displacement = Points::Constant(cloud.positions.rows(), 3, std::numeric_limits<double>::quiet_NaN());
  Measurement& measured = conditions.measured.emplace();
  measured.spread.resize(cloud.positions.rows(), 0);
  if (!outside.empty()) {
    const CraniotomyLoad cortex = joined(rows_of(load, outside), most_measured_points);
    conditions.displacement = prescribed_on_surface_nodes(cloud, cortex, options);
    check_taken(cortex.positions, cloud, conditions.displacement);
    measured.spread = shares(cloud, cortex, options);
    measured.sigma = cortex.sigma;
    measured.cortex = cortex.positions;
    measured.cortex_displacement = cortex.displacement;
    measured.extend = [cloud, cortex, options](const Points& displacement) {
      return prescribed_on_surface_nodes(cloud, {cortex.positions, displacement, {}}, options);
    };
  }
  const CraniotomyLoad inner = joined(rows_of(load, inside), most_measured_points);
  measured.inner = inner.positions;
  measured.inner_displacement = inner.displacement;
  measured.inner_sigma = inner.sigma;
  return conditions;
}

Conditions noisy_field(const NodeCloud& cloud, const Points& displacement, double sigma) {
  if (!(sigma >= smallest_noise)) {
    throw std::invalid_argument("load: a standard deviation of 0.000001 mm or more is needed");
  }
  std::vector<Eigen::Index> nodes;
  for (Eigen::Index a = 0; a < displacement.rows(); ++a) {
    if (displacement.row(a).allFinite()) {
      nodes.push_back(a);
    }
  }
  if (nodes.empty()) {
    throw std::invalid_argument("load: no node has a displacement");
  }
  std::vector<Eigen::Index> measured = spread_out(cloud.positions(nodes, Eigen::all), most_measured_points);
  for (Eigen::Index& row : measured) {
    row = nodes[static_cast<std::size_t>(row)];
  }
  Conditions conditions;
  conditions.displacement = displacement;
  Measurement& m = conditions.measured.emplace();
  m.spread = shares_of_nearest(cloud.positions, nodes, measured);
  m.sigma = Points::Constant(static_cast<Eigen::Index>(measured.size()), 3, sigma);
  m.cortex = cloud.positions(measured, Eigen::all);
  m.cortex_displacement = displacement(measured, Eigen::all);
  return conditions;
}

}  // namespace brainshift::solve
