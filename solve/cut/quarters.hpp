// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>

#include "segmentation/geometry/surface.hpp"

namespace brainshift::solve {

/// The four triangles between the corners and the middles of the sides.
inline std::array<Triangle, 4> quarters(const Triangle& t) {
  const Eigen::Vector3d ab = (t.a + t.b) / 2, bc = (t.b + t.c) / 2, ca = (t.c + t.a) / 2;
  return {{{t.a, ab, ca}, {ab, t.b, bc}, {ca, bc, t.c}, {ab, bc, ca}}};
}

/// How far a corner lies from the centroid, at most.
inline double reach_of(const Triangle& t) {
  const Eigen::Vector3d middle = t.centroid();
  return std::max({(t.a - middle).norm(), (t.b - middle).norm(), (t.c - middle).norm()});
}

}  // namespace brainshift::solve
