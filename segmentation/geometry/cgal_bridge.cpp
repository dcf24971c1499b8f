// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/cgal_bridge.hpp"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>

namespace brainshift {

namespace PMP = CGAL::Polygon_mesh_processing;

std::optional<CgalMesh> to_mesh(const Surface& surface) {
  const CgalSoup soup = to_soup(surface);
  if (!PMP::is_polygon_soup_a_polygon_mesh(soup.triangles)) {
    return std::nullopt;
  }
  CgalMesh mesh;
  PMP::polygon_soup_to_polygon_mesh(soup.points, soup.triangles, mesh);
  return mesh;
}

CgalMesh to_repaired_mesh(const Surface& surface) {
  CgalSoup soup = to_soup(surface);
  PMP::repair_polygon_soup(soup.points, soup.triangles);
  PMP::orient_polygon_soup(soup.points, soup.triangles);
  CgalMesh mesh;
  PMP::polygon_soup_to_polygon_mesh(soup.points, soup.triangles, mesh);
  return mesh;
}

Surface from_mesh(CgalMesh mesh) {
  mesh.collect_garbage();
  Surface surface;
  surface.vertices.resize(static_cast<Eigen::Index>(mesh.number_of_vertices()), 3);
  for (const auto vertex : mesh.vertices()) {
    const CgalPoint& point = mesh.point(vertex);
    surface.vertices.row(static_cast<Eigen::Index>(vertex.idx())) << point.x(), point.y(), point.z();
  }
  surface.triangles.resize(static_cast<Eigen::Index>(mesh.number_of_faces()), 3);
  Eigen::Index row = 0;
  for (const auto face : mesh.faces()) {
    Eigen::Index corner = 0;
    for (const auto vertex : mesh.vertices_around_face(mesh.halfedge(face))) {
      surface.triangles(row, corner++) = static_cast<std::int32_t>(vertex.idx());
    }
    ++row;
  }
  return surface;
}

}  // namespace brainshift
