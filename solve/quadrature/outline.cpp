// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/outline.hpp"

#include <algorithm>
#include <cmath>

#include "solve/quadrature/gauss_points.hpp"
#include "solve/shape/support_search.hpp"

namespace brainshift::solve {

namespace {

using Edge = std::array<std::int32_t, 2>;

struct Candidate {
  double length;
  Edge edge;
};

/// Pairs of surface nodes that may be neighbours, the shortest first.
std::vector<Candidate> candidates(const NodeCloud& cloud) {
  constexpr double farthest = 3;  // spacings
  const SupportSearch search(cloud.positions, cloud.spacing);
  std::vector<Candidate> pairs;
  std::vector<std::int32_t> near;
  for (std::size_t a = 0; a < cloud.size(); ++a) {
    if (cloud.on_surface[a] == 0) {
      continue;
    }
    const auto node = static_cast<std::int32_t>(a);
    search.find(cloud.positions.row(node), farthest, near);
    for (const std::int32_t other : near) {
      if (other > node && cloud.on_surface[static_cast<std::size_t>(other)] != 0) {
        pairs.push_back({(cloud.positions.row(node) - cloud.positions.row(other)).norm(), {node, other}});
      }
    }
  }
  std::ranges::stable_sort(pairs, {}, &Candidate::length);
  return pairs;
}

/// The area of one polygon, by its edges' sum about its first node; each node has two edges.
double area_of_loop(const NodeCloud& cloud, const std::vector<Edge>& neighbours, std::int32_t first,
                    std::vector<std::uint8_t>& seen) {
  double area = 0;
  std::int32_t before = -1, node = first;
  do {
    seen[static_cast<std::size_t>(node)] = 1;
    const Edge& next = neighbours[static_cast<std::size_t>(node)];
    const std::int32_t on = next[0] != before ? next[0] : next[1];
    const auto a = cloud.positions.row(node), b = cloud.positions.row(on);
    area += (a[0] * b[1] - b[0] * a[1]) / 2;
    before = node;
    node = on;
  } while (node != first);
  return std::abs(area);
}

/// Of the largest polygon without the others, which are its holes.
double enclosed_area(const NodeCloud& cloud, const std::vector<Edge>& neighbours) {
  std::vector<std::uint8_t> seen(cloud.size(), 0);
  double most = 0, sum = 0;
  for (std::size_t a = 0; a < cloud.size(); ++a) {
    if (cloud.on_surface[a] != 0 && seen[a] == 0) {
      const double area = area_of_loop(cloud, neighbours, static_cast<std::int32_t>(a), seen);
      most = std::max(most, area);
      sum += area;
    }
  }
  return 2 * most - sum;
}

double area_of(const BackgroundCells& cells) {
  double area = 0;
  std::vector<WeightedPoint> points;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    points.clear();
    gauss_points(cells.kind, corners_of(cells, cell), 1, points);
    area += points.front().volume * cells.inside_fraction[cell];
  }
  return area;
}

}  // namespace

std::vector<Edge> outline(const NodeCloud& cloud, const BackgroundCells& cells) {
  constexpr double area_off = 0.03;  // of the area: a fine lattice errs by less than 0.01
  std::vector<Edge> edges, neighbours(cloud.size(), Edge{-1, -1});
  const auto add = [&](std::int32_t a, std::int32_t b) {
    Edge& of = neighbours[static_cast<std::size_t>(a)];
    of[of[0] < 0 ? 0 : 1] = b;
  };
  const auto open = [&](std::int32_t a) { return neighbours[static_cast<std::size_t>(a)][1] < 0; };
  for (const auto& [length, edge] : candidates(cloud)) {
    if (open(edge[0]) && open(edge[1])) {
      add(edge[0], edge[1]);
      add(edge[1], edge[0]);
      edges.push_back(edge);
    }
  }
  for (std::size_t a = 0; a < cloud.size(); ++a) {
    if (cloud.on_surface[a] != 0 && open(static_cast<std::int32_t>(a))) {
      return {};
    }
  }
  const double area = area_of(cells);
  if (edges.empty() || std::abs(enclosed_area(cloud, neighbours) - area) > area_off * area) {
    return {};
  }
  return edges;
}

bool is_within(const Points& positions, const std::vector<Edge>& edges, const Eigen::Vector3d& x) {
  bool within = false;
  for (const Edge& edge : edges) {
    const auto a = positions.row(edge[0]), b = positions.row(edge[1]);
    if ((a[1] > x[1]) != (b[1] > x[1]) && x[0] < a[0] + (x[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) {
      within = !within;
    }
  }
  return within;
}

}  // namespace brainshift::solve
