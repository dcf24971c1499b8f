// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/opening_shape.hpp"

#include <algorithm>
#include <cmath>

#include "segmentation/geometry/distinct_points.hpp"
#include "segmentation/geometry/point_tree.hpp"
#include "solve/load/best_fit_plane.hpp"
#include "solve/load/convex_hull.hpp"
#include "solve/load/openings.hpp"

namespace brainshift::solve {
namespace {

constexpr double widest_default_margin = 5.0;

/// Whether points lie on a line, to a tenth of its length. plane: that fits them best.
bool is_line(const Plane3& plane, const Points& points) {
  const Eigen::RowVector3d width = plane.local(points).colwise().norm();
  return width[1] <= 0.1 * width[0];
}

/// Of the surface about measured points; absent where there is too little of it.
std::optional<Plane3> plane_about(const Points& measured, const Points& surface) {
  const Points places = distinct_points(measured);
  const PointTree tree(places);
  const Eigen::RowVector3d middle = measured.colwise().mean();
  const double reach = (measured.rowwise() - middle).rowwise().norm().maxCoeff() + 10.0;
  std::vector<Eigen::Index> around;
  for (Eigen::Index n = 0; n < surface.rows(); ++n) {
    const Eigen::RowVector3d place = surface.row(n);
    if (std::sqrt(tree.nearest(place.data()).second) <= std::max(10.0, 0.2 * reach)) {
      around.push_back(n);
    }
  }
  constexpr std::size_t fewest = 6;
  if (around.size() < fewest) {
    return std::nullopt;
  }
  const Points places_around = surface(around, Eigen::all);
  const Plane3 plane = best_fit_plane(places_around);
  return is_line(plane, places_around) ? std::nullopt : std::optional(plane);
}

/// The plane of the measured points; that of the surface about them where they lie on a line, or along one that curves
/// with the surface or scatters in depth, so that their own plane stands on end.
Plane3 opening_plane(const Points& measured, const Points& surface) {
  constexpr double on_end = 0.7;  // cosine of the angle to the surface
  const Plane3 plane = best_fit_plane(measured);
  const std::optional<Plane3> ground = plane_about(measured, surface);
  const bool stands = ground && std::abs(plane.axes.col(2).dot(ground->axes.col(2))) < on_end;
  return is_line(plane, measured) || stands ? ground.value_or(plane) : plane;
}

}  // namespace

std::optional<double> default_margin(const Points& measured) {
  const double distance = usual_distance(measured);
  return distance > 0 ? std::optional(std::min(0.5 * distance, widest_default_margin)) : std::nullopt;
}

OpeningShape::OpeningShape(const CraniotomyLoad& load, const Points& surface, double margin)
    : plane_(opening_plane(load.positions, surface)), margin_(margin), known_(load.positions.rows(), 4) {
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
