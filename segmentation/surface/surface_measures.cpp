// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/surface/surface_measures.hpp"

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include "segmentation/geometry/cgal_bridge.hpp"

namespace brainshift::segmentation {

double mean_edge_length(const Surface& surface) {
  double sum = 0;
  for (const auto& triangle : surface.triangles.rowwise()) {
    for (int corner = 0; corner < 3; ++corner) {
      sum += (surface.vertices.row(triangle[corner]) - surface.vertices.row(triangle[(corner + 1) % 3])).norm();
    }
  }
  return sum / static_cast<double>(surface.triangles.size());
}

SurfaceMeasures measure(const Surface& surface) {
  namespace PMP = CGAL::Polygon_mesh_processing;
  SurfaceMeasures measures;
  measures.vertices = static_cast<std::size_t>(surface.vertices.rows());
  measures.triangles = static_cast<std::size_t>(surface.triangles.rows());
  if (measures.triangles == 0) {
    return measures;
  }
  measures.volume = volume(surface);
  measures.edge_length_mean = mean_edge_length(surface);
  const auto mesh = to_mesh(surface);
  measures.closed = mesh && CGAL::is_closed(*mesh);
  measures.self_intersecting = !mesh || PMP::does_self_intersect(*mesh);
  measures.outward =
      measures.closed && !measures.self_intersecting && PMP::does_bound_a_volume(*mesh) && measures.volume > 0;
  return measures;
}

}  // namespace brainshift::segmentation
