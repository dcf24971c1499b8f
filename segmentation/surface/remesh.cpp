// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/surface/remesh.hpp"

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/repair.h>

#include "segmentation/geometry/cgal_bridge.hpp"

namespace brainshift::segmentation {

Surface remeshed(const Surface& surface, double edge_length) {
  namespace PMP = CGAL::Polygon_mesh_processing;
  CgalMesh mesh = to_repaired_mesh(surface);
  PMP::isotropic_remeshing(mesh.faces(), edge_length, mesh,
                           CGAL::parameters::number_of_iterations(3).number_of_relaxation_steps(2));
  PMP::remove_isolated_vertices(mesh);
  if (!mesh.is_empty() && CGAL::is_closed(mesh)) {
    PMP::orient_to_bound_a_volume(mesh);
  }
  return from_mesh(mesh);
}

}  // namespace brainshift::segmentation
