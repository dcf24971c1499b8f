// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/surface/one_body.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "segmentation/geometry/joined_nodes.hpp"
#include "segmentation/geometry/loose_vertices.hpp"

namespace brainshift::segmentation {

namespace {

/// The triangles of each piece that hangs together.
std::map<std::int32_t, std::vector<Eigen::Index>> triangles_of_pieces(const Surface& surface) {
  JoinedNodes vertices(static_cast<std::size_t>(surface.vertices.rows()));
  for (const auto& corners : surface.triangles.rowwise()) {
    vertices.join(corners[0], corners[1]);
    vertices.join(corners[0], corners[2]);
  }
  std::map<std::int32_t, std::vector<Eigen::Index>> pieces;
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    pieces[vertices.root(surface.triangles(t, 0))].push_back(t);
  }
  return pieces;
}

Surface of_triangles(const Surface& surface, const std::vector<Eigen::Index>& rows) {
  return without_loose_vertices({surface.vertices, surface.triangles(rows, Eigen::all)});
}

/// Of a closed piece.
double volume_of(const Surface& surface, const std::vector<Eigen::Index>& rows) {
  const Eigen::Vector3d origin = surface.vertices.row(surface.triangles(rows.front(), 0));
  double sum = 0;
  for (const Eigen::Index t : rows) {
    const Triangle corners = triangle(surface, t);
    sum += (corners.a - origin).dot((corners.b - origin).cross(corners.c - origin));
  }
  return sum / 6;
}

/// How often a closed surface winds around a point: 1 inside it, 0 outside (solid angles by Van Oosterom and Strackee
/// 1983).
double winding_number(const Surface& surface, const Eigen::RowVector3d& point) {
  double angles = 0;
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    const Triangle corners = triangle(surface, t);
    const Eigen::Vector3d a = corners.a - point.transpose(), b = corners.b - point.transpose(),
                          c = corners.c - point.transpose();
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angles += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angles / (4 * std::numbers::pi);
}

}  // namespace

OneBody one_body(const Surface& surface) {
  constexpr double large = 0.2;  // of the largest
  auto triangles = triangles_of_pieces(surface);
  if (triangles.size() < 2) {
    return {surface};
  }
  std::map<std::int32_t, double> volumes;
  for (const auto& [piece, rows] : triangles) {
    volumes[piece] = volume_of(surface, rows);
  }
  const auto largest = std::ranges::max_element(volumes, {}, [](const auto& each) { return each.second; });
  const Surface body = of_triangles(surface, triangles[largest->first]);
  OneBody result;
  std::vector<Eigen::Index> kept;
  for (const auto& [piece, of_piece] : volumes) {
    const std::vector<Eigen::Index>& rows = triangles[piece];
    const Eigen::RowVector3d place = surface.vertices.row(surface.triangles(rows.front(), 0));
    const bool is_cavity = of_piece < 0 && winding_number(body, place) > 0.5;
    if (piece == largest->first || is_cavity) {
      kept.insert(kept.end(), rows.begin(), rows.end());
      continue;
    }
    if (of_piece > large * largest->second) {
      throw std::invalid_argument(
          "the surface has more than one body, of " + std::to_string(std::lround(largest->second / 1000)) + " and " +
          std::to_string(std::lround(of_piece / 1000)) + " ml; give the brain's as one closed surface, or a label map");
    }
    result.loose_volume += of_piece;
    ++result.loose_pieces;
  }
  result.surface = of_triangles(surface, kept);
  return result;
}

}  // namespace brainshift::segmentation
