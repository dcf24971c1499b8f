// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/openings.hpp"

#include <algorithm>
#include <cstddef>

#include "segmentation/geometry/distinct_points.hpp"
#include "segmentation/geometry/neighbour_distance.hpp"
#include "segmentation/geometry/point_tree.hpp"
#include "segmentation/geometry/quantile.hpp"
#include "solve/load/best_fit_plane.hpp"
#include "solve/load/convex_hull.hpp"
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

Points of_group(const Points& places, const std::vector<int>& group, int which) {
  std::vector<Eigen::Index> rows;
  for (std::size_t p = 0; p < group.size(); ++p) {
    if (group[p] == which) {
      rows.push_back(static_cast<Eigen::Index>(p));
    }
  }
  return places(rows, Eigen::all);
}

/// Whether any of some places lies amid others: within their hull in the plane of all of these, and no farther above or
/// below the others than a dome over them may rise.
bool any_amid(const Points& some, const Points& others) {
  Points all(some.rows() + others.rows(), 3);
  all << some, others;
  const Plane3 plane = best_fit_plane(all);
  const Points ground = plane.local(others), asked = plane.local(some);
  const std::vector<Eigen::Vector2d> hull = convex_hull(ground.leftCols<2>());
  const Eigen::RowVector2d middle = ground.leftCols<2>().colwise().mean();
  const double dome = (ground.leftCols<2>().rowwise() - middle).rowwise().norm().maxCoeff();
  const double lowest = ground.col(2).minCoeff() - dome, highest = ground.col(2).maxCoeff() + dome;
  return hull.size() > 2 && std::any_of(asked.rowwise().begin(), asked.rowwise().end(), [&](const auto& place) {
           const Eigen::Vector2d in_plane = place.template head<2>();
           return place[2] >= lowest && place[2] <= highest && nearest_of_hull(hull, in_plane) == in_plane;
         });
}

/// Points all around others are of their opening, however wide the gap between them. Numbered from 0 on.
void join_rings(const Points& places, std::vector<int>& group) {
  int groups = *std::max_element(group.begin(), group.end()) + 1;
  for (int i = 0; i < groups; ++i) {
    for (int j = 0; j < groups; ++j) {
      if (i != j && any_amid(of_group(places, group, j), of_group(places, group, i))) {
        const int kept = std::min(i, j), joined = std::max(i, j);
        for (int& of_place : group) {
          of_place = of_place == joined ? kept : of_place - (of_place > joined ? 1 : 0);
        }
        --groups;
        i = j = -1;  // from the beginning: the hull has grown
        break;
      }
    }
  }
}

}  // namespace

double usual_distance(const Points& points) {
  const Points places = distinct_points(points);
  if (places.rows() < 2) {
    return 0;
  }
  return median(nearest_neighbours(places, 1).distance);
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
  std::vector<int> group = groups_of(places, std::max(least_gap, usual_distances * usual_distance(places)));
  join_rings(places, group);
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
