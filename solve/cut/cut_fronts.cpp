// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/cut_fronts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "segmentation/geometry/branching_edges.hpp"
#include "segmentation/geometry/nearest_on_segment.hpp"
#include "segmentation/geometry/triangle_distance.hpp"

namespace brainshift::solve {

namespace {

constexpr double reached_within = 0.5;  // spacings, by an end

using Edge = std::array<std::int32_t, 2>;  // vertices, the lower first

Edge edge_of(std::int32_t a, std::int32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

Eigen::Vector3d vertex(const CutFacets& cut, std::int32_t v) {
  return cut.vertices.row(v);
}

/// The pieces of a cut, which must stay as it is.
class Pieces {
 public:
  explicit Pieces(const CutFacets& cut) : cut_(cut), of_vertex_(pieces_of(cut)) {}

  std::int32_t of(std::int32_t vertex) const { return of_vertex_[static_cast<std::size_t>(vertex)]; }

  /// Whether a facet of another piece comes within the reach, mm, of x.
  bool other_is_near(const Eigen::Vector3d& x, std::int32_t piece, double reach) const {
    return std::any_of(cut_.facets.rowwise().begin(), cut_.facets.rowwise().end(), [&](const auto& f) {
      return of(f[0]) != piece && (nearest_on(f, x) - x).squaredNorm() <= reach * reach;
    });
  }

  /// Whether a path of another piece crosses the segment from a to b.
  bool other_crosses(const Eigen::Vector3d& a, const Eigen::Vector3d& b, std::int32_t piece) const {
    const auto side = [](const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector3d& x) {
      return (to - from).cross(x - from).z() > 0;
    };
    return std::any_of(cut_.facets.rowwise().begin(), cut_.facets.rowwise().end(), [&](const auto& f) {
      const Eigen::Vector3d c = vertex(cut_, f[0]), d = vertex(cut_, f[1]);
      return of(f[0]) != piece && side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b);
    });
  }

 private:
  template <class Facet>
  Eigen::Vector3d nearest_on(const Facet& f, const Eigen::Vector3d& x) const {
    const Eigen::Vector3d a = vertex(cut_, f[0]), b = vertex(cut_, f[1]);
    return cut_.planar ? nearest_on_segment(x, a, b)
                       : nearest_on_triangle(frame_of({a, b, vertex(cut_, f[2])}), x).point;
  }

  const CutFacets& cut_;
  std::vector<std::int32_t> of_vertex_;
};

void find_tips(const InsideBody& inside, double spacing, CutFacets& cut) {
  const CutFacets before = cut;  // ends are taken further one by one
  const Pieces pieces(before);
  std::map<std::int32_t, std::vector<std::int32_t>> neighbours;
  for (const auto& f : cut.facets.rowwise()) {
    neighbours[f[0]].push_back(f[1]);
    neighbours[f[1]].push_back(f[0]);
  }
  for (const auto& [v, next] : neighbours) {
    if (next.size() > 1) {
      continue;
    }
    const Eigen::Vector3d end = vertex(before, v), from = vertex(before, next[0]), ahead = (end - from).normalized();
    if (!inside(end + reached_within * spacing * ahead)) {
      cut.vertices.row(v) += spacing * ahead.transpose();
    } else if (!pieces.other_is_near(end, pieces.of(v), reached_within * spacing)) {
      cut.front.push_back({v, v});
    } else if (!pieces.other_crosses(from, end, pieces.of(v))) {
      cut.vertices.row(v) += reached_within * spacing * ahead.transpose();
    }
  }
}

/// Edges of one triangle alone.
class Rims {
 public:
  explicit Rims(const CutFacets& cut) {
    const std::map<Edge, int> triangles = triangles_at_edges(cut.facets);
    for (Eigen::Index t = 0; t < cut.facets.rows(); ++t) {
      for (int i = 0; i < 3; ++i) {
        const Edge edge = edge_of(cut.facets(t, i), cut.facets(t, (i + 1) % 3));
        if (triangles.at(edge) == 1) {
          triangle_of_[edge] = t;
        }
      }
    }
  }

  /// Splits those longer than that near the body, and their triangles with them.
  void split(double longest, const InsideBody& inside, CutFacets& cut) {
    std::vector<Edge> open;
    for (const auto& [edge, triangle] : triangle_of_) {
      open.push_back(edge);
    }
    while (!open.empty()) {
      const Edge edge = open.back();
      open.pop_back();
      const Eigen::Vector3d a = vertex(cut, edge[0]), b = vertex(cut, edge[1]);
      const double length = (b - a).norm();
      if (length > longest && inside.is_within((a + b) / 2, length / 2 + longest)) {
        const std::int32_t middle = bisect(edge, cut);
        open.push_back(edge_of(edge[0], middle));
        open.push_back(edge_of(edge[1], middle));
      }
    }
  }

  /// Calls visit(edge, the corner opposite).
  template <class Visit>
  void for_each(const CutFacets& cut, const Visit& visit) const {
    for (const auto& [edge, triangle] : triangle_of_) {
      const auto f = cut.facets.row(triangle);
      const auto opposite = std::find_if(f.begin(), f.end(), [&e = edge](auto v) { return v != e[0] && v != e[1]; });
      visit(edge, *opposite);
    }
  }

 private:
  /// Returns the new vertex in the edge's middle.
  std::int32_t bisect(const Edge& edge, CutFacets& cut) {
    const Eigen::Index old = triangle_of_.at(edge), fresh = cut.facets.rows();
    const auto middle = static_cast<std::int32_t>(cut.vertices.rows());
    cut.vertices.conservativeResize(middle + 1, 3);
    cut.vertices.row(middle) = (cut.vertices.row(edge[0]) + cut.vertices.row(edge[1])) / 2;
    cut.facets.conservativeResize(fresh + 1, 3);
    cut.facets.row(fresh) = cut.facets.row(old);
    for (int i = 0; i < 3; ++i) {
      cut.facets(old, i) = cut.facets(old, i) == edge[1] ? middle : cut.facets(old, i);
      cut.facets(fresh, i) = cut.facets(fresh, i) == edge[0] ? middle : cut.facets(fresh, i);
    }
    triangle_of_.erase(edge);
    for (const Eigen::Index triangle : {old, fresh}) {
      for (int i = 0; i < 3; ++i) {
        const std::int32_t a = cut.facets(triangle, i), b = cut.facets(triangle, (i + 1) % 3);
        const bool half =
            (a == middle && (b == edge[0] || b == edge[1])) || (b == middle && (a == edge[0] || a == edge[1]));
        if (half || triangle_of_.contains(edge_of(a, b))) {
          triangle_of_[edge_of(a, b)] = triangle;
        }
      }
    }
    return middle;
  }

  std::map<Edge, Eigen::Index> triangle_of_;
};

void find_front_edges(const InsideBody& inside, double spacing, CutFacets& cut) {
  const Rims rims(cut);
  const Pieces pieces(cut);
  rims.for_each(cut, [&](const Edge& edge, std::int32_t opposite) {
    const Eigen::Vector3d a = vertex(cut, edge[0]), b = vertex(cut, edge[1]), middle = (a + b) / 2;
    const Eigen::Vector3d along = (b - a).normalized(), in = vertex(cut, opposite) - middle;
    const Eigen::Vector3d outward = (along * along.dot(in) - in).normalized();
    if (inside(middle + reached_within * spacing * outward) &&
        !pieces.other_is_near(middle, pieces.of(edge[0]), reached_within * spacing)) {
      cut.front.push_back(edge);
    }
  });
}

}  // namespace

void find_fronts(const InsideBody& inside, double spacing, CutFacets& cut) {
  if (cut.planar) {
    find_tips(inside, spacing, cut);
  } else {
    find_front_edges(inside, spacing, cut);
  }
}

void split_long_rims(double longest, const InsideBody& inside, CutFacets& sheet) {
  Rims(sheet).split(longest, inside, sheet);
}

}  // namespace brainshift::solve
