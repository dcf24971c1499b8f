// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/surface_tree.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include "segmentation/geometry/pseudonormals.hpp"
#include "segmentation/geometry/triangle_distance.hpp"
#include "segmentation/geometry/triangle_tree.hpp"

namespace brainshift {
namespace {

/// The triangles beyond the sides ab, bc, ca of a triangle; absent on the rim. Where more than two have an edge they
/// are taken in pairs.
using Across = std::array<std::int32_t, 3>;
constexpr std::int32_t absent = -1;  // a triangle, corner or side

std::vector<Across> across_sides(const Triangles& triangles) {
  std::vector<Across> across(static_cast<std::size_t>(triangles.rows()));
  std::map<std::pair<std::int32_t, std::int32_t>, std::pair<std::int32_t, int>> open;  // side of a triangle
  for (std::int32_t t = 0; t < triangles.rows(); ++t) {
    for (int side = 0; side < 3; ++side) {
      const auto edge = std::minmax({triangles(t, side), triangles(t, (side + 1) % 3)});
      const auto [place, is_new] = open.try_emplace(edge, t, side);
      across[t][side] = absent;
      if (!is_new) {
        const auto [other, its_side] = place->second;
        across[t][side] = other;
        across[other][its_side] = t;
        open.erase(place);
      }
    }
  }
  return across;
}

/// The number of the corner or side in which a place of a triangle lies; absent of another part.
int corner_of(TrianglePart part) {
  return part < TrianglePart::edge_ab ? static_cast<int>(part) : absent;
}
int side_of(TrianglePart part) {
  return part >= TrianglePart::edge_ab && part < TrianglePart::face
             ? static_cast<int>(part) - static_cast<int>(TrianglePart::edge_ab)
             : absent;
}

}  // namespace

struct SurfaceTree::Impl {
  Surface surface;
  std::vector<Eigen::Index> number;  ///< in the surface, of each triangle with an area
  std::vector<Across> across;        ///< of each triangle of the surface
  std::vector<bool> rim_vertex;
  std::vector<Eigen::Vector3d> vertex_normal;  ///< pseudonormals
  TriangleTree tree;

  Eigen::Vector3d face_normal(Eigen::Index t) const { return triangle(surface, t).area_vector().normalized(); }
  bool is_on_rim(Eigen::Index t, TrianglePart part) const;
  Eigen::Vector3d normal(Eigen::Index t, TrianglePart part) const;
};

bool SurfaceTree::Impl::is_on_rim(Eigen::Index t, TrianglePart part) const {
  if (const int side = side_of(part); side != absent) {
    return across[t][side] == absent;
  }
  return corner_of(part) != absent && rim_vertex[surface.triangles(t, corner_of(part))];
}

/// Where two sheets touch, their normals may leave nothing: the triangle's own is then taken.
Eigen::Vector3d SurfaceTree::Impl::normal(Eigen::Index t, TrianglePart part) const {
  constexpr double nothing = 1e-3;
  const Eigen::Vector3d own = face_normal(t);
  Eigen::Vector3d sum = own;
  if (corner_of(part) != absent) {
    sum = vertex_normal[surface.triangles(t, corner_of(part))];
  } else if (const int side = side_of(part); side != absent && across[t][side] != absent) {
    sum += face_normal(across[t][side]);
  }
  return sum.norm() > nothing ? sum.normalized() : own;
}

SurfaceTree::SurfaceTree(const Surface& surface) {
  std::vector<Eigen::Index> number;
  std::vector<Triangle> triangles;
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    const Triangle whole = triangle(surface, t);
    if (whole.area_vector().squaredNorm() > 0) {
      number.push_back(t);
      triangles.push_back(whole);
    }
  }
  if (triangles.empty()) {
    throw std::invalid_argument("a surface has no triangle with an area");
  }
  std::vector<Across> across = across_sides(surface.triangles);
  std::vector<bool> rim_vertex(static_cast<std::size_t>(surface.vertices.rows()), false);
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    for (int side = 0; side < 3; ++side) {
      if (across[t][side] == absent) {
        rim_vertex[surface.triangles(t, side)] = rim_vertex[surface.triangles(t, (side + 1) % 3)] = true;
      }
    }
  }
  impl_ = std::make_shared<const Impl>(Impl{surface, std::move(number), std::move(across), std::move(rim_vertex),
                                            angle_weighted_normals(surface, face_normals(surface)),
                                            TriangleTree(triangles)});
}

SurfacePlace SurfaceTree::nearest(const Eigen::Vector3d& position) const {
  const Eigen::Index t = impl_->number[impl_->tree.nearest(position)];
  const NearestOnTriangle nearest = nearest_on_triangle(frame_of(triangle(impl_->surface, t)), position);
  return {.position = nearest.point,
          .normal = impl_->normal(t, nearest.part),
          .triangle = t,
          .on_rim = impl_->is_on_rim(t, nearest.part)};
}

}  // namespace brainshift
