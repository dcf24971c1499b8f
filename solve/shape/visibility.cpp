// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/shape/visibility.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>

#include "segmentation/geometry/joined_nodes.hpp"
#include "segmentation/geometry/nearest_on_segment.hpp"

namespace brainshift::solve {

std::vector<std::int32_t> pieces_of(const CutFacets& cut) {
  JoinedNodes pieces(static_cast<std::size_t>(cut.vertices.rows()));
  for (const auto& f : cut.facets.rowwise()) {
    for (int i = 1; i < (cut.planar ? 2 : 3); ++i) {
      const auto [low, high] = std::minmax({pieces.root(f[0]), pieces.root(f[i])});
      pieces.join(low, high);
    }
  }
  std::vector<std::int32_t> piece(static_cast<std::size_t>(cut.vertices.rows()));
  std::iota(piece.begin(), piece.end(), 0);
  std::ranges::transform(piece, piece.begin(), [&](std::int32_t v) { return pieces.root(v); });
  return piece;
}

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
  for (const auto& [first, second] : facets_.front) {
    const Eigen::Vector3d begin = vertex(first), edge = vertex(second) - begin;
    const double length = edge.norm();
    const Eigen::Vector3d along = length > 0 ? Eigen::Vector3d(edge / length) : Eigen::Vector3d::Zero();
    front_.push_back({begin, along, begin + edge / 2, length, piece_[static_cast<std::size_t>(first)]});
  }
  if (!facets_.planar) {
    std::vector<Triangle> triangles;
    for (const auto& f : facets_.facets.rowwise()) {
      triangles.push_back({vertex(f[0]), vertex(f[1]), vertex(f[2])});
    }
    tree_.emplace(triangles);
  }
}

bool Visibility::near(const Eigen::Vector3d& x, double reach) const {
  if ((x.array() < low_.array() - reach).any() || (x.array() > high_.array() + reach).any()) {
    return false;
  }
  if (tree_) {
    return tree_->squared_distance(x) <= reach * reach;
  }
  return std::any_of(facets_.facets.rowwise().begin(), facets_.facets.rowwise().end(), [&](const auto& f) {
    return (nearest_on_segment(x, vertex(f[0]), vertex(f[1])) - x).squaredNorm() <= reach * reach;
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
  constexpr double slack = 1 + 1e-12;  // of rounding
  const Eigen::Vector3d centre = (x + node) / 2;
  Detour shortest{std::numeric_limits<double>::infinity(), Eigen::Vector3d::Zero()};
  for (const FrontEdge& edge : front_) {
    // A way over a place is at least twice as long as from the middle between its ends to the place.
    const double reach = slack * (shortest.length + edge.length) / 2;
    if (edge.piece != piece || (edge.middle - centre).squaredNorm() > reach * reach) {
      continue;
    }
    const Eigen::Vector3d& a = edge.begin;
    const double from = edge.along.dot(x - a), to = edge.along.dot(node - a);
    const double off = (x - a - from * edge.along).norm(), node_off = (node - a - to * edge.along).norm();
    const double share = off + node_off > 0 ? off / (off + node_off) : 0;
    const Eigen::Vector3d over = a + std::clamp(from + share * (to - from), 0.0, edge.length) * edge.along;
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
    return longest;  // a segment of one point crosses nothing
  }
  std::int32_t last = -1;
  const auto cross = [&](std::size_t facet) {
    const std::int32_t piece = piece_[static_cast<std::size_t>(facets_.facets(static_cast<Eigen::Index>(facet), 0))];
    if (piece == last) {
      return;  // the way round a piece is one, however many of its facets are crossed
    }
    last = piece;
    const Detour found = round(piece, x, node);
    if (!longest || found.length > longest->length) {
      longest = found;
    }
  };
  if (tree_) {
    std::vector<std::size_t> crossed;
    tree_->find_crossed(x, node, crossed);
    for (const std::size_t facet : crossed) {
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
