// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "segmentation/geometry/surface_tree.hpp"
#include "segmentation/options/values.hpp"
#include "solve/load/craniotomy_load.hpp"
#include "solve/load/load_options.hpp"

namespace brainshift::solve {
namespace {

constexpr double rim_share = 0.05;  ///< displacement at the rim / at the centre

void check(const Surface& brain, const SimulatedCraniotomy& opening) {
  check_table(simulated_craniotomy_options(), opening);
  if (brain.triangles.rows() == 0) {
    throw std::invalid_argument("craniotomy: the brain's surface has no triangle");
  }
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
  const SurfacePlace centre = SurfaceTree(brain).nearest(opening.centre);
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
                                " vertices of the brain's surface lie within " + write_number(opening.radius) +
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
