// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <map>
#include <utility>
#include <vector>

#include "segmentation/geometry/surface.hpp"

namespace brainshift::test {

/// An axis-aligned box of twelve outward triangles.
inline Surface box(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  Surface surface;
  surface.vertices.resize(8, 3);
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      surface.vertices(corner, axis) = (corner >> axis) & 1 ? high[axis] : low[axis];
    }
  }
  surface.triangles.resize(12, 3);
  surface.triangles << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3,
      5, 3, 7, 5;
  return surface;
}

/// An icosahedron, its triangles split in four `rounds` times, its vertices on the sphere.
inline Surface sphere(const Eigen::Vector3d& centre, double radius, int rounds) {
  const double g = 1.618033988749895;
  std::vector<Eigen::Vector3d> points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                         {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  std::vector<Eigen::Vector3i> faces = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                        {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                        {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                        {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int round = 0; round < rounds; ++round) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
      if (is_new) {
        points.push_back(points[static_cast<std::size_t>(a)].normalized() +
                         points[static_cast<std::size_t>(b)].normalized());
      }
      return place->second;
    };
    std::vector<Eigen::Vector3i> finer;
    for (const Eigen::Vector3i& f : faces) {
      const int ab = middle(f[0], f[1]), bc = middle(f[1], f[2]), ca = middle(f[2], f[0]);
      finer.insert(finer.end(), {{f[0], ab, ca}, {f[1], bc, ab}, {f[2], ca, bc}, {ab, bc, ca}});
    }
    faces = finer;
  }
  Surface surface{Points(static_cast<Eigen::Index>(points.size()), 3),
                  Triangles(static_cast<Eigen::Index>(faces.size()), 3)};
  for (std::size_t v = 0; v < points.size(); ++v) {
    surface.vertices.row(static_cast<Eigen::Index>(v)) = centre + radius * points[v].normalized();
  }
  for (std::size_t t = 0; t < faces.size(); ++t) {
    surface.triangles.row(static_cast<Eigen::Index>(t)) = faces[t];
  }
  return surface;
}

}  // namespace brainshift::test
