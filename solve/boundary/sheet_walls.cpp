// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/sheet_walls.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <span>

namespace brainshift::solve {

namespace {

constexpr std::int32_t no_panel = -1;

std::vector<Triangle> triangles_of(const Surface& sheet) {
  std::vector<Triangle> triangles;
  for (Eigen::Index t = 0; t < sheet.triangles.rows(); ++t) {
    triangles.push_back(triangle(sheet, t));
  }
  return triangles;
}

/// The sides of a triangle on which a part of it lies: none for its face, one for an edge, two for a corner.
std::span<const std::size_t> sides_at(TrianglePart part) {
  static constexpr std::array<std::size_t, 6> around = {2, 0, 1, 2, 0, 1};
  switch (part) {
    case TrianglePart::vertex_a:
      return std::span(around).subspan(0, 2);
    case TrianglePart::vertex_b:
      return std::span(around).subspan(1, 2);
    case TrianglePart::vertex_c:
      return std::span(around).subspan(2, 2);
    case TrianglePart::edge_ab:
      return std::span(around).subspan(1, 1);
    case TrianglePart::edge_bc:
      return std::span(around).subspan(2, 1);
    case TrianglePart::edge_ca:
      return std::span(around).subspan(0, 1);
    case TrianglePart::face:
      break;
  }
  return {};
}

}  // namespace

SheetWalls::SheetWalls(const Surface& sheet) : tree_(triangles_of(sheet)) {
  std::map<std::pair<std::int32_t, std::int32_t>, Sides> around;
  for (Eigen::Index t = 0; t < sheet.triangles.rows(); ++t) {
    const Triangle corners = triangle(sheet, t);
    Facet& facet = facets_.emplace_back();
    facet.frame = frame_of(corners);
    facet.normal = corners.area_vector().normalized();
    const std::array<Eigen::Vector3d, 3> sides = {corners.b - corners.a, corners.c - corners.b, corners.a - corners.c};
    for (std::size_t i = 0; i < 3; ++i) {
      facet.inward[i] = facet.normal.cross(sides[i]).normalized();
      const std::int32_t from = sheet.triangles(t, static_cast<Eigen::Index>(i));
      const std::int32_t to = sheet.triangles(t, static_cast<Eigen::Index>((i + 1) % 3));
      around[std::minmax(from, to)].emplace_back(static_cast<std::int32_t>(t), i);
    }
  }
  next_.assign(2 * facets_.size(), {no_panel, no_panel, no_panel});
  for (const auto& [edge, sides] : around) {
    for (const auto& [t, side] : sides) {
      for (const std::int32_t panel : {2 * t, 2 * t + 1}) {
        next_[static_cast<std::size_t>(panel)][side] = next_about(panel, side, sides);
      }
    }
  }
}

Eigen::Vector3d SheetWalls::wall_normal(std::int32_t panel) const {
  return panel % 2 == 0 ? facet(panel).normal : Eigen::Vector3d(-facet(panel).normal);
}

/// Turning about the edge from the panel into the tissue, the first of the other triangles there.
std::int32_t SheetWalls::next_about(std::int32_t panel, std::size_t side, const Sides& around) const {
  const Eigen::Vector3d from = facet(panel).inward[side], up = wall_normal(panel);
  const Eigen::Vector3d axis = from.cross(up);
  double least = std::numeric_limits<double>::infinity();
  std::int32_t next = no_panel;
  for (const auto& [t, i] : around) {
    if (t == panel / 2) {
      continue;
    }
    const Eigen::Vector3d other = facet(2 * t).inward[i];
    double angle = std::atan2(other.dot(up), other.dot(from));
    angle += angle <= 0 ? 2 * std::numbers::pi : 0;
    if (angle < least) {
      least = angle;
      const bool faces_us = facet(2 * t).normal.dot(axis.cross(other)) < 0;
      next = 2 * t + (faces_us ? 0 : 1);
    }
  }
  return next;
}

std::int32_t SheetWalls::nearest_panel(const Eigen::Vector3d& x) const {
  std::int32_t panel = 2 * static_cast<std::int32_t>(tree_.nearest(x));
  const std::int32_t other = panel + 1;
  const auto found = foot(x, panel);
  return found && found->gap < 0 ? other : panel;
}

std::optional<SheetWalls::Foot> SheetWalls::foot(const Eigen::Vector3d& x, std::int32_t& panel) const {
  constexpr double nearer = 1 - 1e-9;  // squared distances that differ less are the same place
  NearestOnTriangle here = nearest_on_triangle(facet(panel).frame, x);
  double squared = (x - here.point).squaredNorm();
  for (bool moved = true; moved;) {
    moved = false;
    for (const std::size_t side : sides_at(here.part)) {
      const std::int32_t neighbour = next(panel, side);
      if (neighbour == no_panel) {
        continue;
      }
      const NearestOnTriangle there = nearest_on_triangle(facet(neighbour).frame, x);
      if (const double less = (x - there.point).squaredNorm(); less < nearer * squared) {
        here = there;
        squared = less;
        panel = neighbour;
        moved = true;
        break;
      }
    }
  }
  Eigen::Vector3d normal = wall_normal(panel);
  for (const std::size_t side : sides_at(here.part)) {
    const std::int32_t neighbour = next(panel, side);
    if (neighbour == no_panel) {
      return std::nullopt;
    }
    normal += wall_normal(neighbour);
  }
  normal.normalize();
  const Eigen::Vector3d away = x - here.point;
  const double distance = std::sqrt(squared), gap = normal.dot(away) < 0 ? -distance : distance;
  constexpr double touching = 1e-6;  // mm: nearer the way to the wall has no direction
  const bool on_ridge = here.part != TrianglePart::face && distance > touching;
  return Foot{gap, on_ridge ? Eigen::Vector3d(away / gap) : normal, here.point};
}

std::vector<std::array<Eigen::Vector3d, 2>> SheetWalls::rim() const {
  std::vector<std::array<Eigen::Vector3d, 2>> edges;
  for (std::size_t t = 0; t < facets_.size(); ++t) {
    const TriangleFrame& frame = facets_[t].frame;
    const std::array<Eigen::Vector3d, 3> corners = {frame.a, frame.a + frame.ab, frame.a + frame.ac};
    for (std::size_t side = 0; side < 3; ++side) {
      if (next_[2 * t][side] == no_panel) {
        edges.push_back({corners[side], corners[(side + 1) % 3]});
      }
    }
  }
  return edges;
}

}  // namespace brainshift::solve
