// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "solve/boundary/triangle_distance.hpp"
#include "solve/load/craniotomy_load.hpp"

namespace brainshift::solve {
namespace {

constexpr double rim_share = 0.05;  ///< displacement at the rim / at the centre

void check(const Surface& brain, const SimulatedCraniotomy& opening) {
  if (!(opening.radius > 0) || !(opening.depth > 0) || !std::isfinite(opening.radius + opening.depth) ||
      !opening.centre.allFinite()) {
    throw std::invalid_argument("craniotomy: radius and depth must be positive, and the centre finite");
  }
  if (brain.triangles.rows() == 0) {
    throw std::invalid_argument("craniotomy: the brain's surface has no triangle");
  }
}

struct Place {
  Eigen::Vector3d position;
  Eigen::Index triangle;
};

Place nearest_place(const Surface& brain, const Eigen::Vector3d& wanted) {
  Place nearest{Eigen::Vector3d::Zero(), -1};
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index t = 0; t < brain.triangles.rows(); ++t) {
    const auto corner = brain.triangles.row(t);
    const Eigen::Vector3d a = brain.vertices.row(corner[0]);
    const TriangleFrame frame{a, brain.vertices.row(corner[1]).transpose() - a,
                              brain.vertices.row(corner[2]).transpose() - a};
    const Eigen::Vector3d position = nearest_on_triangle(frame, wanted).point;
    const double squared = (position - wanted).squaredNorm();
    if (squared < least) {
      least = squared;
      nearest = {position, t};
    }
  }
  if (nearest.triangle < 0) {
    throw std::invalid_argument("craniotomy: the brain's surface has a vertex that is not finite");
  }
  return nearest;
}

/// Normals at the vertices, weighted by area (not of unit length).
Points vertex_normals(const Surface& brain) {
  Points normals = Points::Zero(brain.vertices.rows(), 3);
  for (const auto& corner : brain.triangles.rowwise()) {
    const Eigen::RowVector3d a = brain.vertices.row(corner[0]);
    const Eigen::RowVector3d area = (brain.vertices.row(corner[1]) - a).cross(brain.vertices.row(corner[2]) - a);
    for (const std::int32_t v : corner) {
      normals.row(v) += area;
    }
  }
  return normals;
}

/// The vertices that belong, in rising order, of the piece of surface about the start that hangs together.
template <class Belongs>
std::vector<Eigen::Index> connected(const Surface& brain, Eigen::Index start, const Belongs& belongs) {
  std::vector<std::uint8_t> taken(static_cast<std::size_t>(brain.vertices.rows()), 0);
  for (const std::int32_t v : brain.triangles.row(start)) {
    taken[v] = belongs(v);
  }
  for (bool grew = true; grew;) {
    grew = false;
    for (const auto& corner : brain.triangles.rowwise()) {
      if (!taken[corner[0]] && !taken[corner[1]] && !taken[corner[2]]) {
        continue;
      }
      for (const std::int32_t v : corner) {
        if (!taken[v] && belongs(v)) {
          taken[v] = 1;
          grew = true;
        }
      }
    }
  }
  std::vector<Eigen::Index> vertices;
  for (Eigen::Index v = 0; v < brain.vertices.rows(); ++v) {
    if (taken[v]) {
      vertices.push_back(v);
    }
  }
  return vertices;
}

/// depth at the centre, level there and at the rim.
double sunk(double depth, double radius_share) {
  const double bell = std::pow(1 - radius_share * radius_share, 2);
  return depth * (rim_share + (1 - rim_share) * bell);
}

}  // namespace

CraniotomyLoad simulated_craniotomy(const Surface& brain, const SimulatedCraniotomy& opening) {
  check(brain, opening);
  const Place centre = nearest_place(brain, opening.centre);
  const Points normals = vertex_normals(brain);
  const auto offset = [&](Eigen::Index v) -> Eigen::Vector3d {
    return brain.vertices.row(v).transpose() - centre.position;
  };

  const auto about =
      connected(brain, centre.triangle, [&](Eigen::Index v) { return offset(v).norm() <= opening.radius; });
  const Eigen::Vector3d outward = normals(about, Eigen::all).colwise().sum().transpose().normalized();
  const auto radius = [&](Eigen::Index v) { return offset(v).cross(outward).norm(); };
  const auto under = connected(brain, centre.triangle, [&](Eigen::Index v) {
    return radius(v) <= opening.radius && normals.row(v).dot(outward) > 0;
  });
  if (under.size() < 3) {
    throw std::invalid_argument("craniotomy: only " + std::to_string(under.size()) +
                                " vertices of the brain's surface lie within " + std::to_string(opening.radius) +
                                " mm of the opening's centre; use a wider opening or a finer surface");
  }
  CraniotomyLoad load{brain.vertices(under, Eigen::all), Points(static_cast<Eigen::Index>(under.size()), 3)};
  for (std::size_t p = 0; p < under.size(); ++p) {
    load.displacement.row(static_cast<Eigen::Index>(p)) =
        -sunk(opening.depth, radius(under[p]) / opening.radius) * outward.transpose();
  }
  return load;
}

}  // namespace brainshift::solve
