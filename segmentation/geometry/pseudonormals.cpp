// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/pseudonormals.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

namespace brainshift {
namespace {

struct DirectedEdge {
  std::int32_t from, to;
  std::int32_t triangle;
  int side;  ///< 0: ab, 1: bc, 2: ca

  std::pair<std::int32_t, std::int32_t> key() const { return {from, to}; }
};

void check_arrays(const Surface& surface) {
  if (surface.triangles.rows() == 0) {
    throw std::invalid_argument("signed distance: the surface has no triangle");
  }
  if (surface.triangles.minCoeff() < 0 || surface.triangles.maxCoeff() >= surface.vertices.rows()) {
    throw std::invalid_argument("signed distance: a triangle of the surface names a vertex that does not exist");
  }
  if (!surface.vertices.allFinite()) {
    throw std::invalid_argument("signed distance: a vertex of the surface is not finite");
  }
}

std::vector<DirectedEdge> sorted_edges(const Triangles& triangles) {
  std::vector<DirectedEdge> edges;
  edges.reserve(static_cast<std::size_t>(triangles.rows()) * 3);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int side = 0; side < 3; ++side) {
      edges.push_back({.from = triangles(t, side),
                       .to = triangles(t, (side + 1) % 3),
                       .triangle = static_cast<std::int32_t>(t),
                       .side = side});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const auto& a, const auto& b) { return a.key() < b.key(); });
  return edges;
}

std::string described(const Surface& surface, const DirectedEdge& edge) {
  const Eigen::Vector3d middle = 0.5 * (surface.vertices.row(edge.from) + surface.vertices.row(edge.to));
  return "at (" + std::to_string(middle.x()) + ", " + std::to_string(middle.y()) + ", " + std::to_string(middle.z()) +
         ")";
}

/// Before open edges are looked for: a triangle that is turned leaves some of its edges without an opposite one too.
void check_each_met_once(const Surface& surface, const std::vector<DirectedEdge>& sorted) {
  const auto twice =
      std::adjacent_find(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.key() == b.key(); });
  if (twice != sorted.end()) {
    throw std::invalid_argument("signed distance: the surface is not 2-manifold or not evenly oriented " +
                                described(surface, *twice) + "; repair it first");
  }
}

/// The normals of edges; on the way, that each edge is met once in each direction.
std::vector<std::array<Eigen::Vector3d, 3>> edge_normals(const Surface& surface,
                                                         const std::vector<Eigen::Vector3d>& face) {
  const std::vector<DirectedEdge> edges = sorted_edges(surface.triangles);
  check_each_met_once(surface, edges);
  std::vector<std::array<Eigen::Vector3d, 3>> normals(face.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const DirectedEdge opposite{edges[e].to, edges[e].from, 0, 0};
    const auto twin = std::lower_bound(edges.begin(), edges.end(), opposite,
                                       [](const auto& a, const auto& b) { return a.key() < b.key(); });
    if (twin == edges.end() || twin->key() != opposite.key()) {
      throw std::invalid_argument("signed distance: the surface is open " + described(surface, edges[e]) +
                                  "; close it first");
    }
    const auto own = edges[e].triangle;
    normals[own][edges[e].side] = face[own] + face[twin->triangle];
  }
  return normals;
}

}  // namespace

std::vector<Eigen::Vector3d> face_normals(const Surface& surface) {
  std::vector<Eigen::Vector3d> normals;
  normals.reserve(static_cast<std::size_t>(surface.triangles.rows()));
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    normals.push_back(triangle(surface, t).area_vector().normalized());
  }
  return normals;
}

std::vector<Eigen::Vector3d> angle_weighted_normals(const Surface& surface, const std::vector<Eigen::Vector3d>& face) {
  std::vector<Eigen::Vector3d> normals(static_cast<std::size_t>(surface.vertices.rows()), Eigen::Vector3d::Zero());
  for (std::size_t t = 0; t < face.size(); ++t) {
    const auto corner = surface.triangles.row(t);
    for (int side = 0; side < 3; ++side) {
      const Eigen::Vector3d at = surface.vertices.row(corner[side]);
      const Eigen::Vector3d next = surface.vertices.row(corner[(side + 1) % 3]).transpose() - at;
      const Eigen::Vector3d last = surface.vertices.row(corner[(side + 2) % 3]).transpose() - at;
      const double angle = std::atan2(next.cross(last).norm(), next.dot(last));
      normals[corner[side]] += angle * face[t];
    }
  }
  return normals;
}

const Eigen::Vector3d& Pseudonormals::of(std::size_t triangle, TrianglePart part) const {
  const auto corner = triangles.row(triangle);
  switch (part) {
    case TrianglePart::vertex_a:
      return vertex[corner[0]];
    case TrianglePart::vertex_b:
      return vertex[corner[1]];
    case TrianglePart::vertex_c:
      return vertex[corner[2]];
    case TrianglePart::edge_ab:
      return edge[triangle][0];
    case TrianglePart::edge_bc:
      return edge[triangle][1];
    case TrianglePart::edge_ca:
      return edge[triangle][2];
    case TrianglePart::face:
      break;
  }
  return face[triangle];
}

Pseudonormals pseudonormals(const Surface& surface) {
  check_arrays(surface);
  Pseudonormals normals;
  normals.triangles = surface.triangles;
  normals.face = face_normals(surface);
  normals.edge = edge_normals(surface, normals.face);
  if (!(volume(surface) > 0)) {
    throw std::invalid_argument("signed distance: the surface is inside out or encloses nothing; turn its triangles");
  }
  normals.vertex = angle_weighted_normals(surface, normals.face);
  return normals;
}

}  // namespace brainshift
