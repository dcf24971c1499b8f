// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/body/check_surface.hpp"

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <stdexcept>
#include <string>

#include "segmentation/geometry/cgal_bridge.hpp"

namespace brainshift::discretise {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

[[noreturn]] void refuse(const std::string& why) {
  throw std::invalid_argument("the brain surface " + why);
}

void check_numbers(const Surface& surface) {
  if (surface.triangles.rows() < 4) {
    refuse("has " + std::to_string(surface.triangles.rows()) + " triangles; a closed surface has at least 4.");
  }
  for (Eigen::Index i = 0; i < surface.vertices.rows(); ++i) {
    if (!surface.vertices.row(i).allFinite()) {
      refuse("has a coordinate that is not finite at vertex " + std::to_string(i) + ".");
    }
  }
  if (surface.triangles.minCoeff() < 0 || surface.triangles.maxCoeff() >= surface.vertices.rows()) {
    refuse("has a triangle that names a vertex which does not exist.");
  }
}

std::size_t border_edges(const CgalMesh& mesh) {
  std::size_t count = 0;
  for (const auto halfedge : mesh.halfedges()) {
    count += mesh.is_border(halfedge) ? 1 : 0;
  }
  return count;
}

}  // namespace

void check_encloses_body(const Surface& surface) {
  check_numbers(surface);
  const std::optional<CgalMesh> mesh = to_mesh(surface);
  if (!mesh) {
    refuse("is not a 2-manifold with triangles that agree in orientation; repair it (the segment stage can).");
  }
  if (const std::size_t open = border_edges(*mesh); open > 0) {
    refuse("is open: " + std::to_string(open) +
           " edges have a triangle on one side only; close it (the segment stage "
           "can).");
  }
  if (pmp::does_self_intersect(*mesh)) {
    refuse("intersects itself; repair it (the segment stage can).");
  }
  if (!(volume(surface) > 0) || !pmp::does_bound_a_volume(*mesh)) {
    refuse("is inside out: its triangles must be counter-clockwise seen from outside; flip them.");
  }
}

}  // namespace brainshift::discretise
