// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/verification/slice.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <Eigen/Geometry>
#include <map>
#include <set>
#include <stdexcept>

#include "tests/verification/clouds.hpp"

namespace brainshift::verification {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex>>;

using Edge = std::pair<std::int32_t, std::int32_t>;  // of the surface, lower vertex first

/// The edges that cross the plane; those of one triangle are neighbours. Heights above the plane decide.
std::map<Edge, std::vector<Edge>> crossed_edges(const Triangles& triangles, const Eigen::VectorXd& height) {
  std::map<Edge, std::vector<Edge>> neighbours;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    std::vector<Edge> crossed;
    for (int i = 0; i < 3; ++i) {
      const std::int32_t a = triangles(t, i), b = triangles(t, (i + 1) % 3);
      if ((height[a] > 0) != (height[b] > 0)) {
        crossed.emplace_back(std::min(a, b), std::max(a, b));
      }
    }
    if (crossed.size() == 2) {
      neighbours[crossed[0]].push_back(crossed[1]);
      neighbours[crossed[1]].push_back(crossed[0]);
    }
  }
  return neighbours;
}

std::vector<Edge> longest_loop(const std::map<Edge, std::vector<Edge>>& neighbours) {
  std::set<Edge> seen;
  std::vector<Edge> longest;
  for (const auto& [start, unused] : neighbours) {
    std::vector<Edge> loop;
    for (const Edge* edge = &start; edge != nullptr;) {
      loop.push_back(*edge);
      seen.insert(*edge);
      const std::vector<Edge>& next = neighbours.at(*edge);
      const auto unseen = std::find_if(next.begin(), next.end(), [&](const Edge& e) { return !seen.contains(e); });
      edge = unseen == next.end() ? nullptr : &*unseen;
    }
    longest = loop.size() > longest.size() ? loop : longest;
  }
  return longest;
}

double signed_area(const Points& outline) {
  double twice = 0;
  for (Eigen::Index i = 0; i < outline.rows(); ++i) {
    const Eigen::RowVector3d a = outline.row(i), b = outline.row((i + 1) % outline.rows());
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return twice / 2;
}

/// How far inside the line a place is, mm; negative outside.
double depth_inside(const Points& outline, const Eigen::RowVector3d& x) {
  bool inside = false;
  double nearest = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < outline.rows(); ++i) {
    const Eigen::RowVector3d a = outline.row(i), b = outline.row((i + 1) % outline.rows()), along = b - a;
    const double share = std::clamp((x - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (a + share * along - x).norm());
    if ((a[1] > x[1]) != (b[1] > x[1]) && x[0] < a[0] + (x[1] - a[1]) / along[1] * along[0]) {
      inside = !inside;
    }
  }
  return inside ? nearest : -nearest;
}

}  // namespace

Points section(const Surface& surface, const Eigen::Vector3d& origin, const Eigen::Vector3d& right,
               const Eigen::Vector3d& up) {
  const Eigen::Vector3d x = right.normalized(), normal = x.cross(up).normalized(), y = normal.cross(x);
  const Points from = surface.vertices.rowwise() - origin.transpose();
  const Eigen::VectorXd height = from * normal;
  const std::vector<Edge> loop = longest_loop(crossed_edges(surface.triangles, height));
  if (loop.size() < 3) {
    throw std::runtime_error("the plane does not cut the surface");
  }
  Points outline(static_cast<Eigen::Index>(loop.size()), 3);
  for (Eigen::Index i = 0; i < outline.rows(); ++i) {
    const auto [a, b] = loop[static_cast<std::size_t>(i)];
    const double share = height[a] / (height[a] - height[b]);
    const Eigen::Vector3d place = (1 - share) * from.row(a) + share * from.row(b);
    outline.row(i) << place.dot(x), place.dot(y), 0;
  }
  return signed_area(outline) > 0 ? outline : Points(outline.colwise().reverse());
}

NodeCloud cloud_in(const Points& outline, double least_distance, unsigned seed) {
  Darts darts(least_distance, seed);
  const Eigen::Index corners = outline.rows();
  std::vector<double> until = {0};
  for (Eigen::Index i = 0; i < corners; ++i) {
    until.push_back(until.back() + (outline.row((i + 1) % corners) - outline.row(i)).norm());
  }
  darts.along(until.back(), true, [&](double share) {
    const double at = (share - std::floor(share)) * until.back();
    const auto i = static_cast<std::size_t>(std::upper_bound(until.begin(), until.end(), at) - until.begin()) - 1;
    const auto row = static_cast<Eigen::Index>(i);
    const double part = (at - until[i]) / (until[i + 1] - until[i]);
    return Eigen::Vector3d((1 - part) * outline.row(row) + part * outline.row((row + 1) % corners));
  });
  const Eigen::RowVector3d low = outline.colwise().minCoeff(), size = outline.colwise().maxCoeff() - low;
  for (int in_vain = 0; in_vain < 3000;) {
    const Eigen::Vector3d place(low[0] + darts.uniform() * size[0], low[1] + darts.uniform() * size[1], 0);
    const bool deep = depth_inside(outline, place.transpose()) > 0.5 * least_distance;
    in_vain = deep && darts.put(place, false) ? 0 : in_vain + 1;
  }
  return darts.cloud(true);
}

BackgroundCells triangles_in(const Points& outline, const Points& nodes) {
  std::vector<std::pair<Kernel::Point_2, std::int32_t>> places;
  for (Eigen::Index a = 0; a < nodes.rows(); ++a) {
    places.emplace_back(Kernel::Point_2(nodes(a, 0), nodes(a, 1)), static_cast<std::int32_t>(a));
  }
  const Delaunay delaunay(places.begin(), places.end());
  BackgroundCells cells;
  cells.kind = CellKind::triangle;
  cells.vertices = nodes;
  for (auto face = delaunay.finite_faces_begin(); face != delaunay.finite_faces_end(); ++face) {
    const std::int32_t corner[3] = {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()};
    const Eigen::RowVector3d centre = (nodes.row(corner[0]) + nodes.row(corner[1]) + nodes.row(corner[2])) / 3;
    if (depth_inside(outline, centre) > 0) {
      cells.connectivity.insert(cells.connectivity.end(), corner, corner + 3);
      cells.label.push_back(1);
    }
  }
  cells.inside_fraction.assign(cells.label.size(), 1.0);
  return cells;
}

}  // namespace brainshift::verification
