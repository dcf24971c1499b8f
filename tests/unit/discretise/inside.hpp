// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Side_of_triangle_mesh.h>

#include "segmentation/geometry/cgal_bridge.hpp"

namespace brainshift::test {

/// CGAL's exact inside test; the surface is closed.
class Inside {
 public:
  explicit Inside(const Surface& surface) : mesh_(to_mesh(surface).value()), side_(mesh_) {}
  bool operator()(const double* x) const { return side_({x[0], x[1], x[2]}) == CGAL::ON_BOUNDED_SIDE; }

 private:
  CgalMesh mesh_;
  CGAL::Side_of_triangle_mesh<CgalMesh, CgalKernel> side_;
};

}  // namespace brainshift::test
