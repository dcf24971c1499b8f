// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "segmentation/geometry/distinct_points.hpp"
#include "segmentation/geometry/neighbour_distance.hpp"
#include "segmentation/geometry/point_tree.hpp"
#include "solve/arrays/shared_work.hpp"
#include "solve/load/convex_hull.hpp"
#include "solve/load/craniotomy_load.hpp"
#include "solve/load/extension.hpp"
#include "solve/load/load_options.hpp"
#include "solve/load/near_surface.hpp"

namespace brainshift::solve {
namespace {

constexpr double widest_default_margin = 5.0;

void check_load(const CraniotomyLoad& load) {
  if (load.positions.rows() == 0 || load.positions.rows() != load.displacement.rows()) {
    throw std::invalid_argument("load: no displacement is measured, or not one at each position");
  }
  for (Eigen::Index p = 0; p < load.positions.rows(); ++p) {
    if (!load.positions.row(p).allFinite() || !load.displacement.row(p).allFinite()) {
      throw std::invalid_argument("load: measured point " + std::to_string(p + 1) + " is not finite");
    }
  }
}

std::vector<Eigen::Index> surface_nodes(const NodeCloud& cloud) {
  std::vector<Eigen::Index> nodes;
  for (std::size_t n = 0; n < cloud.size(); ++n) {
    if (cloud.on_surface[n] != 0) {
      nodes.push_back(static_cast<Eigen::Index>(n));
    }
  }
  if (nodes.empty()) {
    throw std::invalid_argument("load: the cloud has no surface node (on_surface is 0 everywhere) to carry a load");
  }
  return nodes;
}

double distance_to(const PointTree& points, const Eigen::RowVector3d& place) {
  return std::sqrt(points.nearest(place.data()).second);
}

/// A plane with two axes in it and its normal.
struct Plane {
  Eigen::RowVector3d origin;
  Eigen::Matrix3d axes;  ///< columns: wide, narrow, normal

  Points local(const Points& points) const { return (points.rowwise() - origin) * axes; }
};

Plane best_fit_plane(const Points& points) {
  const Eigen::RowVector3d centre = points.colwise().mean();
  const Points about = points.rowwise() - centre;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(about.transpose() * about);
  return {centre, spread.eigenvectors().rowwise().reverse()};
}

/// The plane of the measured points; with that of the surface nodes about them where they lie on a line.
Plane opening_plane(const Points& measured, const Points& surface) {
  const Plane plane = best_fit_plane(measured);
  const Eigen::RowVector3d width = plane.local(measured).colwise().norm();
  if (width[1] > 0.1 * width[0]) {
    return plane;
  }
  const Points places = distinct_points(measured);
  const PointTree tree(places);
  const double reach = (measured.rowwise() - plane.origin).rowwise().norm().maxCoeff() + 10.0;
  std::vector<Eigen::Index> around;
  for (Eigen::Index n = 0; n < surface.rows(); ++n) {
    if (distance_to(tree, surface.row(n)) <= std::max(10.0, 0.2 * reach)) {
      around.push_back(n);
    }
  }
  return around.size() < 3 ? plane : best_fit_plane(surface(around, Eigen::all));
}

double default_margin(const Points& measured, const NodeCloud& cloud, const std::vector<Eigen::Index>& nodes,
                      const PointTree& surface) {
  const Points places = distinct_points(measured);
  if (places.rows() == 1) {
    return cloud.spacing[static_cast<std::size_t>(nodes[surface.nearest(places.data()).first])];
  }
  std::vector<double> distances = nearest_neighbours(places, 1).distance;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return std::min(0.5 * *middle, widest_default_margin);
}

}  // namespace

Points prescribed_on_surface_nodes(const NodeCloud& cloud, const CraniotomyLoad& load, const OpeningOptions& options) {
  check_table(opening_options(), options);
  check_load(load);
  const std::vector<Eigen::Index> nodes = surface_nodes(cloud);
  const Points surface = cloud.positions(nodes, Eigen::all);
  const PointTree surface_tree(surface);
  check_near_surface(load.positions, surface, options.farthest);
  check_moved(load.displacement, surface);
  const double margin =
      options.margin >= 0 ? options.margin : default_margin(load.positions, cloud, nodes, surface_tree);
  const Plane plane = opening_plane(load.positions, surface);
  const Points measured = plane.local(load.positions), candidates = plane.local(surface);
  const PlanePoints in_plane = measured.leftCols<2>();
  const std::vector<Eigen::Vector2d> hull = convex_hull(in_plane);
  Values known(measured.rows(), 4);
  known << measured.col(2), load.displacement;

  Points prescribed = Points::Constant(cloud.positions.rows(), 3, std::numeric_limits<double>::quiet_NaN());
  const double lowest = known.col(0).minCoeff(), highest = known.col(0).maxCoeff();
  const double far =
      options.depth + extension_overshoot * (highest - lowest);  // from all that the splines can be there
  share_work(candidates.rows(), places_a_part, [&](std::int64_t n) {
    const Eigen::RowVector3d place = candidates.row(n);
    if (place[2] < lowest - far || place[2] > highest + far || distance_to_hull(hull, place.head<2>()) > margin) {
      return;
    }
    const Eigen::VectorXd height_and_displacement = extended(in_plane, known, place.head<2>());
    if (std::abs(place[2] - height_and_displacement[0]) <= options.depth) {
      prescribed.row(nodes[static_cast<std::size_t>(n)]) = height_and_displacement.tail<3>();
    }
  });
  if (prescribed.array().isNaN().all()) {
    const Points places = distinct_points(load.positions);
    const PointTree tree(places);
    double nearest_miss = std::numeric_limits<double>::infinity();
    for (const auto& node : surface.rowwise()) {
      nearest_miss = std::min(nearest_miss, distance_to(tree, node));
    }
    throw std::invalid_argument(
        "load: no surface node lies under the opening; the nearest is " + rounded(nearest_miss) +
        " mm from a measured point: measure more points, or use a finer cloud or a wider margin");
  }
  return prescribed;
}

}  // namespace brainshift::solve
