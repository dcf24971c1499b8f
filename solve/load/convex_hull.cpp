// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/convex_hull.hpp"

#include <algorithm>
#include <limits>

namespace brainshift::solve {
namespace {

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

double distance_to_segment(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& place) {
  const Eigen::Vector2d along = b - a;
  const double length_squared = along.squaredNorm();
  const double t = length_squared > 0 ? std::clamp(along.dot(place - a) / length_squared, 0.0, 1.0) : 0.0;
  return (a + t * along - place).norm();
}

/// Appends the chain of corners that turns left all along the places, without its last one.
template <class Iterator>
void append_chain(Iterator first, Iterator last, std::vector<Eigen::Vector2d>& hull) {
  const std::size_t start = hull.size();
  for (; first != last; ++first) {
    while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), *first) <= 0) {
      hull.pop_back();
    }
    hull.push_back(*first);
  }
  hull.pop_back();
}

}  // namespace

std::vector<Eigen::Vector2d> convex_hull(const PlanePoints& points) {
  std::vector<Eigen::Vector2d> places;
  for (const auto& point : points.rowwise()) {
    places.emplace_back(point);
  }
  const auto before = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::sort(places.begin(), places.end(), before);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  if (places.size() < 2) {
    return places;
  }
  std::vector<Eigen::Vector2d> hull;
  append_chain(places.begin(), places.end(), hull);
  append_chain(places.rbegin(), places.rend(), hull);
  return hull;
}

double distance_to_hull(const std::vector<Eigen::Vector2d>& hull, const Eigen::Vector2d& place) {
  bool inside = hull.size() > 2;
  double distance = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < hull.size(); ++n) {
    const Eigen::Vector2d& next = hull[(n + 1) % hull.size()];
    inside = inside && turn(hull[n], next, place) >= 0;
    distance = std::min(distance, distance_to_segment(hull[n], next, place));
  }
  return inside ? 0.0 : distance;
}

}  // namespace brainshift::solve
