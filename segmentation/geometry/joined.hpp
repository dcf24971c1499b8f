// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/geometry/surface.hpp"

namespace brainshift {

/// Two surfaces as one.
inline Surface joined(const Surface& a, const Surface& b) {
  Surface both{Points(a.vertices.rows() + b.vertices.rows(), 3), Triangles(a.triangles.rows() + b.triangles.rows(), 3)};
  both.vertices << a.vertices, b.vertices;
  both.triangles << a.triangles, b.triangles.array() + static_cast<std::int32_t>(a.vertices.rows());
  return both;
}

}  // namespace brainshift
