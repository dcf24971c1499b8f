// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/septum.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "segmentation/files/surface_file.hpp"
#include "segmentation/geometry/same_places.hpp"

namespace brainshift::solve {

Septum read_septum(const std::filesystem::path& file) {
  Septum septum{file.string(), read_surface(file)};
  join_at_same_places(septum.sheet.vertices, septum.sheet.triangles);
  check_septum(septum, false);
  return septum;
}

void check_septum(const Septum& septum, bool planar) {
  constexpr double least_height = 1e-6;  // of the longest side
  if (planar) {
    throw std::invalid_argument(septum.name + ": a septum is a sheet in space; leave it out of a plane problem");
  }
  if (septum.sheet.triangles.rows() == 0) {
    throw std::invalid_argument(septum.name + ": the septum has no triangle");
  }
  for (Eigen::Index t = 0; t < septum.sheet.triangles.rows(); ++t) {
    const Triangle corners = triangle(septum.sheet, t);
    const Eigen::Vector3d sides[] = {corners.b - corners.a, corners.c - corners.b, corners.a - corners.c};
    const double longest = std::max({sides[0].squaredNorm(), sides[1].squaredNorm(), sides[2].squaredNorm()});
    if (!(2 * corners.area_vector().norm() > least_height * longest)) {
      const Eigen::Vector3d at = corners.centroid();
      std::ostringstream text;
      text << septum.name << ": triangle " << t + 1 << " of the septum has no area, at (" << at.x() << ", " << at.y()
           << ", " << at.z() << ") mm; remove it";
      throw std::invalid_argument(text.str());
    }
  }
}

}  // namespace brainshift::solve
