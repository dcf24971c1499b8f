// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/opening_shape.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "segmentation/geometry/distinct_points.hpp"
#include "segmentation/geometry/point_tree.hpp"
#include "solve/load/convex_hull.hpp"
#include "solve/load/openings.hpp"

namespace brainshift::solve {
namespace {

constexpr double widest_default_margin = 5.0;

/// A plane with two axes in it and its normal.
struct Plane {
  Eigen::RowVector3d origin;
  Eigen::Matrix3d axes;
};

Plane best_fit_plane(const Points& points) {
  const Eigen::RowVector3d centre = points.colwise().mean();
  const Points about = points.rowwise() - centre;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(about.transpose() * about);
  return {centre, spread.eigenvectors().rowwise().reverse()};
}

/// The plane of the measured points; with that of the surface about them where they lie on a line.
Plane opening_plane(const Points& measured, const Points& surface) {
  const Plane plane = best_fit_plane(measured);
  const Eigen::RowVector3d width = ((measured.rowwise() - plane.origin) * plane.axes).colwise().norm();
  if (width[1] > 0.1 * width[0]) {
    return plane;
  }
  const Points places = distinct_points(measured);
  const PointTree tree(places);
  const double reach = (measured.rowwise() - plane.origin).rowwise().norm().maxCoeff() + 10.0;
  std::vector<Eigen::Index> around;
  for (Eigen::Index n = 0; n < surface.rows(); ++n) {
    const Eigen::RowVector3d place = surface.row(n);
    if (std::sqrt(tree.nearest(place.data()).second) <= std::max(10.0, 0.2 * reach)) {
      around.push_back(n);
    }
  }
  return around.size() < 3 ? plane : best_fit_plane(surface(around, Eigen::all));
}

}  // namespace

std::optional<double> default_margin(const Points& measured) {
  const double distance = usual_distance(measured);
  return distance > 0 ? std::optional(std::min(0.5 * distance, widest_default_margin)) : std::nullopt;
}

OpeningShape::OpeningShape(const CraniotomyLoad& load, const Points& surface, double margin)
    : margin_(margin), known_(load.positions.rows(), 4) {
  const Plane plane = opening_plane(load.positions, surface);
  origin_ = plane.origin;
  axes_ = plane.axes;
  const Points measured = local(load.positions);
  points_ = measured.leftCols<2>();
  known_ << measured.col(2), load.displacement;
  lowest_ = measured.col(2).minCoeff();
  highest_ = measured.col(2).maxCoeff();
  hull_ = convex_hull(points_);
}

double OpeningShape::beyond_rim(const Eigen::RowVector3d& place) const {
  const Eigen::Vector2d in_plane = place.head<2>();
  return (in_plane - nearest_of_hull(hull_, in_plane)).norm() - margin_;
}

std::optional<Eigen::RowVector3d> OpeningShape::displacement_at(const Eigen::RowVector3d& place, double past,
                                                                double depth) const {
  const double far = depth + extension_overshoot * (highest_ - lowest_);  // from all that the splines can be there
  if (place[2] < lowest_ - far || place[2] > highest_ + far) {
    return std::nullopt;
  }
  Eigen::Vector2d in_plane = place.head<2>();
  const Eigen::Vector2d of_hull = nearest_of_hull(hull_, in_plane);
  const double away = (in_plane - of_hull).norm();
  if (away > margin_ + past) {
    return std::nullopt;
  }
  if (away > margin_) {
    in_plane = of_hull + margin_ / away * (in_plane - of_hull);
  }
  const Eigen::VectorXd height_and_displacement = extended(points_, known_, in_plane);
  if (std::abs(place[2] - height_and_displacement[0]) > depth) {
    return std::nullopt;
  }
  return height_and_displacement.tail<3>().transpose();
}

}  // namespace brainshift::solve
