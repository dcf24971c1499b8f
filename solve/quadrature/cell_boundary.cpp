// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/cell_boundary.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <vector>

#include "segmentation/geometry/same_places.hpp"

namespace brainshift::solve {

namespace {

using Face = std::array<int, 4>;  // corners of a cell; the fourth is -1 in a triangle, the last two in an edge

constexpr Face hexahedron[] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
constexpr Face tetrahedron[] = {{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}};
constexpr Face quadrilateral[] = {{0, 1, -1, -1}, {1, 2, -1, -1}, {2, 3, -1, -1}, {3, 0, -1, -1}};
constexpr Face triangle_edges[] = {{0, 1, -1, -1}, {1, 2, -1, -1}, {2, 0, -1, -1}};

std::span<const Face> faces_of(CellKind kind) {
  switch (kind) {
    case CellKind::hexahedron:
      return hexahedron;
    case CellKind::tetrahedron:
      return tetrahedron;
    case CellKind::quadrilateral:
      return quadrilateral;
    case CellKind::triangle:
      return triangle_edges;
  }
  return {};
}

/// Vertices of the faces that one cell alone has, in the cell's order.
std::vector<Face> single_faces(const BackgroundCells& cells) {
  const std::vector<std::int32_t> first = first_at_same_place(cells.vertices);  // cells may share no vertex
  std::map<Face, std::pair<int, Face>> count;                                   // by its sorted vertices
  const auto corners = static_cast<std::size_t>(cells.corners());
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    for (const Face& corner : faces_of(cells.kind)) {
      Face face;
      std::transform(corner.begin(), corner.end(), face.begin(), [&](int k) {
        const auto place = corners * cell + static_cast<std::size_t>(std::max(k, 0));
        return k < 0 ? -1 : first[static_cast<std::size_t>(cells.connectivity[place])];
      });
      Face key = face;
      std::sort(key.begin(), key.end());
      auto& [times, vertices] = count[key];
      ++times;
      vertices = face;
    }
  }
  std::vector<Face> single;
  for (const auto& [key, found] : count) {
    if (found.first == 1) {
      single.push_back(found.second);
    }
  }
  return single;
}

}  // namespace

Surface strips(const Points& vertices, std::span<const std::array<std::int32_t, 2>> edges) {
  const auto count = static_cast<Eigen::Index>(edges.size());
  Surface surface{Points(4 * count, 3), Triangles(2 * count, 3)};
  for (Eigen::Index e = 0; e < count; ++e) {
    const auto& edge = edges[static_cast<std::size_t>(e)];
    const Eigen::RowVector3d a = vertices.row(edge[0]), b = vertices.row(edge[1]);
    const Eigen::RowVector3d up(0, 0, (b - a).norm() / 2);
    surface.vertices.middleRows<4>(4 * e) << a - up, b - up, b + up, a + up;
    const auto first = static_cast<std::int32_t>(4 * e);
    surface.triangles.middleRows<2>(2 * e) << first, first + 1, first + 2, first, first + 2, first + 3;
  }
  return surface;
}

Surface cell_boundary(const BackgroundCells& cells) {
  Surface surface;
  if (std::any_of(cells.inside_fraction.begin(), cells.inside_fraction.end(), [](double share) { return share < 1; })) {
    return surface;
  }
  const std::vector<Face> faces = single_faces(cells);
  if (is_planar(cells.kind)) {
    std::vector<std::array<std::int32_t, 2>> edges;
    for (const Face& face : faces) {
      edges.push_back({face[0], face[1]});
    }
    return strips(cells.vertices, edges);
  }
  const auto count = static_cast<Eigen::Index>(faces.size());
  surface.vertices = cells.vertices;
  const Eigen::Index halves = cells.kind == CellKind::hexahedron ? 2 : 1;
  surface.triangles.resize(halves * count, 3);
  for (Eigen::Index f = 0; f < count; ++f) {
    const Face& v = faces[static_cast<std::size_t>(f)];
    surface.triangles.row(halves * f) << v[0], v[1], v[2];
    if (halves == 2) {
      surface.triangles.row(halves * f + 1) << v[0], v[2], v[3];
    }
  }
  return surface;
}

}  // namespace brainshift::solve
