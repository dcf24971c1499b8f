// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "segmentation/geometry/cgal_bridge.hpp"
#include "segmentation/surface/remesh.hpp"

namespace brainshift::segmentation {
namespace {

double width_of_hole(const CgalMesh& mesh, CgalMesh::Halfedge_index border) {
  CGAL::Bbox_3 box;
  for (const auto vertex : mesh.vertices_around_face(border)) {
    box += mesh.point(vertex).bbox();
  }
  return std::max({box.x_span(), box.y_span(), box.z_span()});
}

}  // namespace

ClosedHoles with_holes_closed(const Surface& surface, double widest) {
  namespace PMP = CGAL::Polygon_mesh_processing;
  CgalMesh mesh = to_repaired_mesh(surface);
  std::vector<CgalMesh::Halfedge_index> borders;
  PMP::extract_boundary_cycles(mesh, std::back_inserter(borders));
  std::size_t closed = 0;
  for (const auto border : borders) {
    if (width_of_hole(mesh, border) <= widest) {
      std::vector<CgalMesh::Face_index> triangles;
      PMP::triangulate_hole(mesh, border, std::back_inserter(triangles));
      closed += triangles.empty() ? 0 : 1;
    }
  }
  return {from_mesh(std::move(mesh)), closed};
}

}  // namespace brainshift::segmentation
