// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/visibility.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>

namespace brainshift::solve {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangle = Kernel::Triangle_3;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Triangle>::const_iterator>;
using BoxTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 point(const Eigen::Vector3d& x) {
  return {x.x(), x.y(), x.z()};
}

Eigen::Vector3d nearest_on_edge(const Eigen::Vector3d& x, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double squared = along.squaredNorm();
  return squared > 0 ? a + std::clamp((x - a).dot(along) / squared, 0.0, 1.0) * along : a;
}

/// Of each vertex the lowest that it hangs together with.
std::vector<std::int32_t> pieces_of(const CutFacets& cut) {
  std::vector<std::int32_t> piece(static_cast<std::size_t>(cut.vertices.rows()));
  std::iota(piece.begin(), piece.end(), 0);
  const auto at = [&](std::int32_t v) -> std::int32_t& { return piece[static_cast<std::size_t>(v)]; };
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& f : cut.facets.rowwise()) {
      const std::int32_t lowest = std::min({at(f[0]), at(f[1]), cut.planar ? at(f[1]) : at(f[2])});
      for (int i = 0; i < (cut.planar ? 2 : 3); ++i) {
        changed = changed || at(f[i]) != lowest;
        at(f[i]) = lowest;
      }
    }
  }
  return piece;
}

}  // namespace

/// Boxes about the triangles of a sheet; queries may run on many threads.
struct Visibility::Tree {
  std::vector<Triangle> triangles;
  BoxTree boxes;

  explicit Tree(const CutFacets& f) {
    for (const auto& t : f.facets.rowwise()) {
      triangles.emplace_back(point(f.vertices.row(t[0])), point(f.vertices.row(t[1])), point(f.vertices.row(t[2])));
    }
    boxes.insert(triangles.cbegin(), triangles.cend());
    boxes.build();
    boxes.accelerate_distance_queries();
  }
};

LevelSets level_sets(const Eigen::Vector3d& x, const Eigen::Vector3d& end, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d away = x - end, v = direction.normalized();
  return {away.x() * v.y() - away.y() * v.x(), away.x() * v.x() + away.y() * v.y()};
}

Visibility::Visibility(CutFacets facets)
    : facets_(std::move(facets)),
      low_(facets_.vertices.colwise().minCoeff()),
      high_(facets_.vertices.colwise().maxCoeff()) {
  piece_ = pieces_of(facets_);
  for (const auto& f : facets_.facets.rowwise()) {
    const Eigen::Vector3d a = vertex(f[0]), along = vertex(f[1]) - a;
    const Eigen::Vector3d normal =
        facets_.planar ? Eigen::Vector3d(-along.y(), along.x(), 0) : along.cross(vertex(f[2]) - a);
    plane_.push_back({a, normal.normalized()});
  }
  if (!facets_.planar) {
    tree_ = std::make_shared<const Tree>(facets_);
  }
}

bool Visibility::near(const Eigen::Vector3d& x, double reach) const {
  if ((x.array() < low_.array() - reach).any() || (x.array() > high_.array() + reach).any()) {
    return false;
  }
  if (tree_) {
    return tree_->boxes.squared_distance(point(x)) <= reach * reach;
  }
  return std::any_of(facets_.facets.rowwise().begin(), facets_.facets.rowwise().end(), [&](const auto& f) {
    return (nearest_on_edge(x, vertex(f[0]), vertex(f[1])) - x).squaredNorm() <= reach * reach;
  });
}

/// By the level sets of the segment's end: on opposite sides of its line, and across the line behind the end.
bool Visibility::segment_between(std::size_t facet, const Eigen::Vector3d& x, const Eigen::Vector3d& node) const {
  const auto f = facets_.facets.row(static_cast<Eigen::Index>(facet));
  const Eigen::Vector3d end = vertex(f[1]), along = end - vertex(f[0]);
  const LevelSets from = level_sets(x, end, along), to = level_sets(node, end, along);
  const bool left = from.psi <= 0, node_left = to.psi <= 0;
  if (left == node_left) {
    return false;
  }
  const double share = from.psi / (from.psi - to.psi), phi = from.phi + share * (to.phi - from.phi);
  const double length = along.norm(), slack = 1e-9 * length;  // no gap between one segment and the next
  return phi <= slack && phi >= -length - slack;
}

bool Visibility::between(std::size_t facet, const Eigen::Vector3d& x, const Eigen::Vector3d& node) const {
  const Plane& plane = plane_[facet];
  return (plane.normal.dot(x - plane.origin) >= 0) != (plane.normal.dot(node - plane.origin) >= 0);
}

/// Over a straight edge the way is shortest where it meets the edge at the same angle on both sides.
Detour Visibility::round(std::int32_t piece, const Eigen::Vector3d& x, const Eigen::Vector3d& node) const {
  Detour shortest{std::numeric_limits<double>::infinity(), Eigen::Vector3d::Zero()};
  for (const auto& [first, second] : facets_.front) {
    if (piece_[static_cast<std::size_t>(first)] != piece) {
      continue;
    }
    const Eigen::Vector3d a = vertex(first), edge = vertex(second) - a;
    Eigen::Vector3d over = a;
    if (const double length = edge.norm(); length > 0) {
      const Eigen::Vector3d along = edge / length;
      const double from = along.dot(x - a), to = along.dot(node - a);
      const double off = (x - a - from * along).norm(), node_off = (node - a - to * along).norm();
      const double share = off + node_off > 0 ? off / (off + node_off) : 0;
      over += std::clamp(from + share * (to - from), 0.0, length) * along;
    }
    const double way = (x - over).norm() + (node - over).norm();
    if (way < shortest.length) {
      shortest = {way, (x - over).normalized()};
    }
  }
  return shortest;
}

std::optional<Detour> Visibility::detour(const Eigen::Vector3d& x, const Eigen::Vector3d& node) const {
  std::optional<Detour> longest;
  if (x == node) {
    return longest;  // CGAL takes no segment of one point
  }
  const auto cross = [&](std::size_t facet) {
    const Detour found =
        round(piece_[static_cast<std::size_t>(facets_.facets(static_cast<Eigen::Index>(facet), 0))], x, node);
    if (!longest || found.length > longest->length) {
      longest = found;
    }
  };
  if (tree_) {
    std::vector<BoxTree::Primitive_id> crossed;
    tree_->boxes.all_intersected_primitives(Kernel::Segment_3(point(x), point(node)), std::back_inserter(crossed));
    for (const auto& triangle : crossed) {
      const auto facet = static_cast<std::size_t>(triangle - tree_->triangles.cbegin());
      if (between(facet, x, node)) {
        cross(facet);
      }
    }
  } else {
    for (std::size_t f = 0; f < plane_.size(); ++f) {
      if (segment_between(f, x, node)) {
        cross(f);
      }
    }
  }
  return longest;
}

}  // namespace brainshift::solve
