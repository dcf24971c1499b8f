// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/convex_hull.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>

#include <algorithm>
#include <iterator>
#include <limits>

namespace brainshift::solve {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_2 as_cgal(const Eigen::Vector2d& place) {
  return {place.x(), place.y()};
}

}  // namespace

std::vector<Eigen::Vector2d> convex_hull(const PlanePoints& points) {
  std::vector<Kernel::Point_2> places, corners;
  for (const auto& point : points.rowwise()) {
    places.push_back(as_cgal(point));
  }
  CGAL::convex_hull_2(places.begin(), places.end(), std::back_inserter(corners));
  std::vector<Eigen::Vector2d> hull;
  for (const Kernel::Point_2& corner : corners) {
    hull.emplace_back(corner.x(), corner.y());
  }
  return hull;
}

Eigen::Vector2d nearest_of_hull(const std::vector<Eigen::Vector2d>& hull, const Eigen::Vector2d& place) {
  const Kernel::Point_2 here = as_cgal(place);
  bool inside = hull.size() > 2;
  Eigen::Vector2d nearest = hull.front();
  for (std::size_t n = 0; n < hull.size(); ++n) {
    const Eigen::Vector2d &from = hull[n], &to = hull[(n + 1) % hull.size()];
    inside = inside && !CGAL::right_turn(as_cgal(from), as_cgal(to), here);
    const Eigen::Vector2d side = to - from;
    const double along = (place - from).dot(side) / std::max(side.squaredNorm(), std::numeric_limits<double>::min());
    const Eigen::Vector2d on_side = from + std::clamp(along, 0.0, 1.0) * side;
    if ((place - on_side).squaredNorm() < (place - nearest).squaredNorm()) {
      nearest = on_side;
    }
  }
  return inside ? place : nearest;
}

}  // namespace brainshift::solve
