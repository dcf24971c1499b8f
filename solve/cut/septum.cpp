// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/septum.hpp"

#include <stdexcept>

#include "segmentation/files/surface_file.hpp"
#include "segmentation/geometry/same_places.hpp"
#include "solve/cut/sheet_topology.hpp"

namespace brainshift::solve {

Septum read_septum(const std::filesystem::path& file) {
  Septum septum{file.string(), read_surface(file)};
  join_at_same_places(septum.sheet.vertices, septum.sheet.triangles);
  check_septum(septum, false);
  return septum;
}

void check_septum(const Septum& septum, bool planar) {
  if (planar) {
    throw std::invalid_argument(septum.name + ": a septum is a sheet in space; leave it out of a plane problem");
  }
  if (septum.sheet.triangles.rows() == 0) {
    throw std::invalid_argument(septum.name + ": the septum has no triangle");
  }
  check_triangles(septum.sheet, septum.name);
}

}  // namespace brainshift::solve
