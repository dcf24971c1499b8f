// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/plane.hpp"

#include <sstream>

namespace brainshift {

std::optional<std::string> off_plane(const Points& points, const std::string& what) {
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    if (!(points(i, 2) == 0)) {
      std::ostringstream text;
      text << what << " " << i << " has z = " << points(i, 2) << " mm; a planar problem lies in the plane z = 0.";
      return text.str();
    }
  }
  return std::nullopt;
}

}  // namespace brainshift
