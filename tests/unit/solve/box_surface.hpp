// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/geometry/surface.hpp"

namespace brainshift::test {

/// A closed box, outward, as a skull.
inline Surface box_surface(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  Surface box;
  box.vertices.resize(8, 3);
  for (int i = 0; i < 8; ++i) {
    box.vertices.row(i) << (i & 1 ? high : low).x(), (i & 2 ? high : low).y(), (i & 4 ? high : low).z();
  }
  box.triangles.resize(12, 3);
  box.triangles << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3,
      7, 5;
  return box;
}

}  // namespace brainshift::test
