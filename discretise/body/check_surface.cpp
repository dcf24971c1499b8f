// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/body/check_surface.hpp"

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/repair.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "segmentation/geometry/cgal_bridge.hpp"

namespace brainshift::discretise {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

[[noreturn]] void refuse(const std::string& what, const std::string& why) {
  throw std::invalid_argument(what + " " + why);
}

void check_numbers(const Surface& surface, const std::string& what) {
  if (surface.triangles.rows() < 4) {
    refuse(what, "has " + std::to_string(surface.triangles.rows()) + " triangles; a closed surface has at least 4.");
  }
  for (Eigen::Index i = 0; i < surface.vertices.rows(); ++i) {
    if (!surface.vertices.row(i).allFinite()) {
      refuse(what, "has a coordinate that is not finite at vertex " + std::to_string(i) + ".");
    }
  }
  if (surface.triangles.minCoeff() < 0 || surface.triangles.maxCoeff() >= surface.vertices.rows()) {
    refuse(what, "has a triangle that names a vertex which does not exist.");
  }
}

std::size_t border_edges(const CgalMesh& mesh) {
  std::size_t count = 0;
  for (const auto halfedge : mesh.halfedges()) {
    count += mesh.is_border(halfedge) ? 1 : 0;
  }
  return count;
}

/// The shells that face the other way than a body's do, whose outermost face outward and those within by turns, each by
/// its number and first triangle, and how many shells there are. The numbers are in the order of the triangles.
struct WrongShells {
  std::vector<std::pair<std::size_t, CgalMesh::Face_index>> wrong;
  std::size_t all = 0;
};

WrongShells wrong_shells(CgalMesh& mesh) {
  const auto volume_of = mesh.add_property_map<CgalMesh::Face_index, std::size_t>("f:volume").first;
  const auto shell_of = mesh.add_property_map<CgalMesh::Face_index, std::size_t>("f:shell").first;
  std::vector<std::size_t> depth;
  std::vector<bool> outward;
  pmp::volume_connected_components(mesh, volume_of,
                                   CGAL::parameters::face_connected_component_map(shell_of)
                                       .nesting_levels(std::ref(depth))
                                       .is_cc_outward_oriented(std::ref(outward)));
  WrongShells shells;
  for (const auto face : mesh.faces()) {
    const std::size_t shell = shell_of[face];
    if (shell < shells.all) {
      continue;
    }
    ++shells.all;  // CGAL numbers the shells as it meets them
    if (outward[shell] != (depth[shell] % 2 == 0)) {
      shells.wrong.emplace_back(shell + 1, face);
    }
  }
  return shells;
}

[[noreturn]] void refuse_orientation(CgalMesh& mesh, const std::string& what) {
  const WrongShells shells = wrong_shells(mesh);
  if (shells.wrong.empty() || shells.wrong.size() == shells.all) {
    refuse(what, "is inside out: its triangles must be counter-clockwise seen from outside; flip them.");
  }
  const auto& [shell, face] = shells.wrong.front();
  refuse(what, "is inside out in part: shell " + std::to_string(shell) + " of " + std::to_string(shells.all) +
                   " faces the wrong way, that of triangle " + std::to_string(static_cast<std::size_t>(face)) +
                   "; flip the triangles of this shell alone, or remove it.");
}

}  // namespace

void check_encloses_body(const Surface& surface, const std::string& what) {
  check_numbers(surface, what);
  std::optional<CgalMesh> mesh = to_mesh(surface);
  if (!mesh) {
    refuse(what, "is not a 2-manifold with triangles that agree in orientation; repair it (the segment stage can).");
  }
  pmp::remove_isolated_vertices(*mesh);  // CGAL reads beyond its memory where the outermost vertex has no triangle
  if (const std::size_t open = border_edges(*mesh); open > 0) {
    refuse(what, "is open: " + std::to_string(open) +
                     " edges have a triangle on one side only; close it (the segment stage "
                     "can).");
  }
  if (pmp::does_self_intersect(*mesh)) {
    refuse(what, "intersects itself; repair it (the segment stage can).");
  }
  if (!(volume(surface) > 0) || !pmp::does_bound_a_volume(*mesh)) {
    refuse_orientation(*mesh, what);
  }
}

}  // namespace brainshift::discretise
