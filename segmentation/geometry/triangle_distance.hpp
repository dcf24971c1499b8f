// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "segmentation/geometry/surface.hpp"

namespace brainshift {

/// The part of a triangle abc in which its nearest point lies.
enum class TrianglePart : int { vertex_a, vertex_b, vertex_c, edge_ab, edge_bc, edge_ca, face };

struct NearestOnTriangle {
  Eigen::Vector3d point;
  TrianglePart part;
};

/// A triangle made ready for many distance queries: corner and edge vectors, mm. Its area must not be zero.
struct TriangleFrame {
  Eigen::Vector3d a, ab, ac;
};

inline TriangleFrame frame_of(const Triangle& t) {
  return {t.a, t.b - t.a, t.c - t.a};
}

/// The point of a triangle nearest to p, by the Voronoi regions of its corners, edges and face. CGAL has the distance,
/// but does not say which part is nearest, and the sign depends on that.
inline NearestOnTriangle nearest_on_triangle(const TriangleFrame& t, const Eigen::Vector3d& p) {
  const Eigen::Vector3d ap = p - t.a;
  const double d1 = t.ab.dot(ap), d2 = t.ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) {
    return {t.a, TrianglePart::vertex_a};
  }
  const Eigen::Vector3d bp = ap - t.ab;
  const double d3 = t.ab.dot(bp), d4 = t.ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) {
    return {t.a + t.ab, TrianglePart::vertex_b};
  }
  const double c_side = d1 * d4 - d3 * d2;
  if (c_side <= 0 && d1 >= 0 && d3 <= 0) {
    return {t.a + d1 / (d1 - d3) * t.ab, TrianglePart::edge_ab};
  }
  const Eigen::Vector3d cp = ap - t.ac;
  const double d5 = t.ab.dot(cp), d6 = t.ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) {
    return {t.a + t.ac, TrianglePart::vertex_c};
  }
  const double b_side = d5 * d2 - d1 * d6;
  if (b_side <= 0 && d2 >= 0 && d6 <= 0) {
    return {t.a + d2 / (d2 - d6) * t.ac, TrianglePart::edge_ca};
  }
  const double a_side = d3 * d6 - d5 * d4;
  if (a_side <= 0 && d4 >= d3 && d5 >= d6) {
    const double along = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {t.a + t.ab + along * (t.ac - t.ab), TrianglePart::edge_bc};
  }
  const double sum = a_side + b_side + c_side;
  return {t.a + b_side / sum * t.ab + c_side / sum * t.ac, TrianglePart::face};
}

}  // namespace brainshift
