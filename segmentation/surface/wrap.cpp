// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/alpha_wrap_3.h>

#include "segmentation/geometry/cgal_bridge.hpp"
#include "segmentation/surface/remesh.hpp"

namespace brainshift::segmentation {

Surface wrapped(const Surface& surface, double opening) {
  const CgalSoup soup = to_soup(surface);
  CgalMesh wrap;
  CGAL::alpha_wrap_3(soup.points, soup.triangles, opening, opening / 30.0, wrap);
  return from_mesh(wrap);
}

}  // namespace brainshift::segmentation
