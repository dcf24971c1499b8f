// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/surface_tree.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "solve/boundary/triangle_distance.hpp"

namespace brainshift::solve {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangle = Kernel::Triangle_3;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Triangle>::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

/// Edges and vertices of a triangle that lie on the rim.
struct Rim {
  bool edge[3];
  bool vertex[3];
};

std::vector<Rim> rims(const Surface& surface) {
  std::set<std::pair<std::int32_t, std::int32_t>> open;
  for (const auto& corner : surface.triangles.rowwise()) {
    for (int side = 0; side < 3; ++side) {
      const auto edge = std::minmax({corner[side], corner[(side + 1) % 3]});
      if (const auto [place, is_new] = open.insert(edge); !is_new) {
        open.erase(place);
      }
    }
  }
  std::vector<bool> rim_vertex(static_cast<std::size_t>(surface.vertices.rows()), false);
  for (const auto& [a, b] : open) {
    rim_vertex[a] = rim_vertex[b] = true;
  }
  std::vector<Rim> rims(static_cast<std::size_t>(surface.triangles.rows()));
  for (std::size_t t = 0; t < rims.size(); ++t) {
    const auto corner = surface.triangles.row(static_cast<Eigen::Index>(t));
    for (int side = 0; side < 3; ++side) {
      rims[t].edge[side] = open.contains(std::minmax({corner[side], corner[(side + 1) % 3]}));
      rims[t].vertex[side] = rim_vertex[corner[side]];
    }
  }
  return rims;
}

bool is_on_rim(const Rim& rim, TrianglePart part) {
  switch (part) {
    case TrianglePart::vertex_a:
      return rim.vertex[0];
    case TrianglePart::vertex_b:
      return rim.vertex[1];
    case TrianglePart::vertex_c:
      return rim.vertex[2];
    case TrianglePart::edge_ab:
      return rim.edge[0];
    case TrianglePart::edge_bc:
      return rim.edge[1];
    case TrianglePart::edge_ca:
      return rim.edge[2];
    case TrianglePart::face:
      break;
  }
  return false;
}

}  // namespace

struct SurfaceTree::Impl {
  std::vector<TriangleFrame> frames;
  std::vector<Rim> rims;
  std::vector<Triangle> triangles;
  Tree tree;
};

SurfaceTree::SurfaceTree(const Surface& surface) {
  auto impl = std::make_shared<Impl>();
  const auto point = [](const Eigen::Vector3d& p) { return Kernel::Point_3(p.x(), p.y(), p.z()); };
  const std::vector<Rim> all_rims = rims(surface);
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    const auto corner = surface.triangles.row(t);
    const Eigen::Vector3d a = surface.vertices.row(corner[0]), b = surface.vertices.row(corner[1]),
                          c = surface.vertices.row(corner[2]);
    if (!((b - a).cross(c - a).squaredNorm() > 0)) {
      continue;
    }
    impl->frames.push_back({a, b - a, c - a});
    impl->rims.push_back(all_rims[t]);
    impl->triangles.emplace_back(point(a), point(b), point(c));
  }
  if (impl->triangles.empty()) {
    throw std::invalid_argument("load: a surface has no triangle with an area");
  }
  impl->tree.insert(impl->triangles.cbegin(), impl->triangles.cend());
  impl->tree.accelerate_distance_queries();
  impl_ = std::move(impl);
}

SurfacePlace SurfaceTree::nearest(const Eigen::Vector3d& position) const {
  const Kernel::Point_3 query(position.x(), position.y(), position.z());
  const auto t = impl_->tree.closest_point_and_primitive(query).second - impl_->triangles.cbegin();
  const TriangleFrame& frame = impl_->frames[t];
  const NearestOnTriangle nearest = nearest_on_triangle(frame, position);
  return {nearest.point, frame.ab.cross(frame.ac).normalized(), is_on_rim(impl_->rims[t], nearest.part)};
}

}  // namespace brainshift::solve
