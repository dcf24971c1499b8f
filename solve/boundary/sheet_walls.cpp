// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/sheet_walls.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

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

}  // namespace

SheetWalls::SheetWalls(const Surface& sheet) : tree_(triangles_of(sheet)) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::pair<std::int32_t, int>>> around;
  for (Eigen::Index t = 0; t < sheet.triangles.rows(); ++t) {
    Facet& facet = facets_.emplace_back();
    facet.normal = triangle(sheet, t).area_vector().normalized();
    for (int i = 0; i < 3; ++i) {
      const std::int32_t from = sheet.triangles(t, i), to = sheet.triangles(t, (i + 1) % 3);
      const Eigen::Vector3d corner = sheet.vertices.row(from), end = sheet.vertices.row(to);
      facet.sides[static_cast<std::size_t>(i)] = {corner, (end - corner).cross(facet.normal).normalized()};
      around[std::minmax(from, to)].emplace_back(static_cast<std::int32_t>(t), i);
    }
  }
  next_.assign(2 * facets_.size(), {no_panel, no_panel, no_panel});
  for (const auto& [edge, sides] : around) {
    for (const auto& [t, side] : sides) {
      for (const std::int32_t panel : {2 * t, 2 * t + 1}) {
        next_[static_cast<std::size_t>(panel)][static_cast<std::size_t>(side)] = next_about(panel, side, sides);
      }
    }
  }
}

Eigen::Vector3d SheetWalls::wall_normal(std::int32_t panel) const {
  const Eigen::Vector3d& normal = facets_[static_cast<std::size_t>(panel / 2)].normal;
  return panel % 2 == 0 ? normal : Eigen::Vector3d(-normal);
}

/// Turning about the edge from the panel into the tissue, the first of the other triangles there.
std::int32_t SheetWalls::next_about(std::int32_t panel, int side,
                                    const std::vector<std::pair<std::int32_t, int>>& around) const {
  const auto inward = [&](std::int32_t t, int i) -> Eigen::Vector3d {
    return -facets_[static_cast<std::size_t>(t)].sides[static_cast<std::size_t>(i)].outward;
  };
  const Eigen::Vector3d from = inward(panel / 2, side), up = wall_normal(panel);
  const Eigen::Vector3d axis = from.cross(up);
  double least = std::numeric_limits<double>::infinity();
  std::int32_t next = no_panel;
  for (const auto& [t, i] : around) {
    if (t == panel / 2) {
      continue;
    }
    const Eigen::Vector3d other = inward(t, i);
    double angle = std::atan2(other.dot(up), other.dot(from));
    angle += angle <= 0 ? 2 * std::numbers::pi : 0;
    if (angle < least) {
      least = angle;
      const bool faces_us = facets_[static_cast<std::size_t>(t)].normal.dot(axis.cross(other)) < 0;
      next = 2 * t + (faces_us ? 0 : 1);
    }
  }
  return next;
}

std::int32_t SheetWalls::nearest_panel(const Eigen::Vector3d& x) const {
  const std::size_t t = tree_.nearest(x);
  const bool above = facets_[t].normal.dot(x - facets_[t].sides[0].corner) >= 0;
  return 2 * static_cast<std::int32_t>(t) + (above ? 0 : 1);
}

std::optional<SheetWalls::Foot> SheetWalls::foot(const Eigen::Vector3d& x, std::int32_t& panel) const {
  constexpr int most_panels = 50;  // a node slides over less in a step; a corner may send it round
  std::int32_t before = no_panel;
  for (int i = 0; i < most_panels; ++i) {
    const Facet& facet = facets_[static_cast<std::size_t>(panel / 2)];
    double farthest = 0;
    std::int32_t next = no_panel;
    bool outside = false;
    for (std::size_t side = 0; side < 3; ++side) {
      const double beyond = facet.sides[side].outward.dot(x - facet.sides[side].corner);
      const std::int32_t neighbour = next_[static_cast<std::size_t>(panel)][side];
      outside = outside || beyond > 0;
      if (beyond > farthest && neighbour != no_panel) {
        farthest = beyond;
        next = neighbour;
      }
    }
    if (outside && next == no_panel) {
      return std::nullopt;
    }
    if (next == no_panel || next == before) {  // over a ridge neither of its panels has the foot: the ridge has
      break;
    }
    before = std::exchange(panel, next);
  }
  const Eigen::Vector3d normal = wall_normal(panel);
  return Foot{normal.dot(x - facets_[static_cast<std::size_t>(panel / 2)].sides[0].corner), normal};
}

}  // namespace brainshift::solve
