// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/surface_tree.hpp"

#include <Eigen/Geometry>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "segmentation/geometry/triangle_distance.hpp"
#include "segmentation/geometry/triangle_tree.hpp"

namespace brainshift {
namespace {

/// Edges and vertices of a triangle that lie on the rim.
struct Rim {
  bool edge[3];
  bool vertex[3];
};

std::vector<Rim> rims_of(const Surface& surface) {
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
  std::vector<Eigen::Index> number;  ///< in the surface, of each triangle with an area
  std::vector<TriangleFrame> frames;
  std::vector<Rim> rims;
  TriangleTree tree;
};

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
  std::vector<TriangleFrame> frames;
  std::vector<Rim> rims;
  const std::vector<Rim> all_rims = rims_of(surface);
  for (std::size_t i = 0; i < number.size(); ++i) {
    frames.push_back(frame_of(triangles[i]));
    rims.push_back(all_rims[static_cast<std::size_t>(number[i])]);
  }
  impl_ = std::make_shared<const Impl>(
      Impl{std::move(number), std::move(frames), std::move(rims), TriangleTree(triangles)});
}

SurfacePlace SurfaceTree::nearest(const Eigen::Vector3d& position) const {
  const std::size_t i = impl_->tree.nearest(position);
  const TriangleFrame& frame = impl_->frames[i];
  const NearestOnTriangle nearest = nearest_on_triangle(frame, position);
  return {.position = nearest.point,
          .normal = frame.ab.cross(frame.ac).normalized(),
          .triangle = impl_->number[i],
          .on_rim = is_on_rim(impl_->rims[i], nearest.part)};
}

}  // namespace brainshift
