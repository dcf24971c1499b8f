// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/openings.hpp"

#include <algorithm>
#include <cstddef>

#include "segmentation/geometry/distinct_points.hpp"
#include "segmentation/geometry/neighbour_distance.hpp"
#include "segmentation/geometry/point_tree.hpp"
#include "solve/load/spread_out.hpp"

namespace brainshift::solve {

namespace {

constexpr double least_gap = 30.0;     // mm
constexpr double usual_distances = 3;  // that a gap is wider than
constexpr Eigen::Index linked = 300;   // of very many points so many, spread out, tell the gaps

/// Of each place the ordinal of what it hangs together with by steps of at most `gap`.
std::vector<int> groups_of(const Points& places, double gap) {
  constexpr int none = -1;
  std::vector<int> group(static_cast<std::size_t>(places.rows()), none);
  int groups = 0;
  for (std::size_t first = 0; first < group.size(); ++first) {
    std::vector<std::size_t> reached;
    if (group[first] == none) {
      group[first] = groups++;
      reached.push_back(first);
    }
    while (!reached.empty()) {
      const std::size_t from = reached.back();
      reached.pop_back();
      for (std::size_t to = 0; to < group.size(); ++to) {
        const auto step = places.row(static_cast<Eigen::Index>(to)) - places.row(static_cast<Eigen::Index>(from));
        if (group[to] == none && step.norm() <= gap) {
          group[to] = group[from];
          reached.push_back(to);
        }
      }
    }
  }
  return group;
}

}  // namespace

double usual_distance(const Points& points) {
  const Points places = distinct_points(points);
  if (places.rows() < 2) {
    return 0;
  }
  std::vector<double> distances = nearest_neighbours(places, 1).distance;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

CraniotomyLoad rows_of(const CraniotomyLoad& load, const std::vector<Eigen::Index>& rows) {
  CraniotomyLoad part{load.positions(rows, Eigen::all), load.displacement(rows, Eigen::all), {}};
  if (load.sigma.rows() > 0) {
    part.sigma = load.sigma(rows, Eigen::all);
  }
  return part;
}

std::vector<CraniotomyLoad> openings(const CraniotomyLoad& load) {
  const Points places = load.positions(spread_out(load.positions, linked), Eigen::all);
  const std::vector<int> group = groups_of(places, std::max(least_gap, usual_distances * usual_distance(places)));
  const int groups = *std::max_element(group.begin(), group.end()) + 1;
  if (groups == 1) {
    return {load};
  }
  const PointTree tree(places);
  std::vector<std::vector<Eigen::Index>> rows(static_cast<std::size_t>(groups));
  for (Eigen::Index p = 0; p < load.positions.rows(); ++p) {
    const Eigen::RowVector3d place = load.positions.row(p);
    rows[static_cast<std::size_t>(group[tree.nearest(place.data()).first])].push_back(p);
  }
  std::vector<CraniotomyLoad> parts;
  for (const std::vector<Eigen::Index>& of_group : rows) {
    parts.push_back(rows_of(load, of_group));
  }
  return parts;
}

}  // namespace brainshift::solve
