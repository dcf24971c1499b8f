// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include "segmentation/geometry/surface.hpp"

namespace brainshift::test {

/// A square of n × n vertices, 10 mm wide, in z = 5; a triangle is left out where `leave_out` says so.
inline Surface square(int n, const std::function<bool(int, int)>& leave_out = {}) {
  Surface sheet{Points(n * n, 3), Triangles(0, 3)};
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      sheet.vertices.row(j * n + i) << 10.0 * i / (n - 1), 10.0 * j / (n - 1), 5;
      if (i + 1 < n && j + 1 < n && !(leave_out && leave_out(i, j))) {
        const std::int32_t corner = j * n + i;
        triangles.push_back({corner, corner + 1, corner + n + 1});
        triangles.push_back({corner, corner + n + 1, corner + n});
      }
    }
  }
  sheet.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    sheet.triangles.row(static_cast<Eigen::Index>(t)) << triangles[t][0], triangles[t][1], triangles[t][2];
  }
  return sheet;
}

inline Surface with_triangles(Surface sheet, const std::vector<std::array<double, 3>>& vertices,
                              const std::vector<std::array<std::int32_t, 3>>& triangles) {
  for (const auto& v : vertices) {
    sheet.vertices.conservativeResize(sheet.vertices.rows() + 1, Eigen::NoChange);
    sheet.vertices.bottomRows<1>() << v[0], v[1], v[2];
  }
  for (const auto& t : triangles) {
    sheet.triangles.conservativeResize(sheet.triangles.rows() + 1, Eigen::NoChange);
    sheet.triangles.bottomRows<1>() << t[0], t[1], t[2];
  }
  return sheet;
}

/// A band of n quadrilaterals around the z axis, turned half round for each of `half_turns`.
inline Surface band(int n, int half_turns) {
  Surface sheet{Points(2 * n, 3), Triangles(2 * n, 3)};
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n, turn = half_turns * angle / 2;
    const Eigen::RowVector3d out(std::cos(angle), std::sin(angle), 0);
    const Eigen::RowVector3d across = 3 * (std::sin(turn) * out + std::cos(turn) * Eigen::RowVector3d::UnitZ());
    sheet.vertices.row(2 * i) = 10 * out - across;
    sheet.vertices.row(2 * i + 1) = 10 * out + across;
    const bool crossed = i + 1 == n && half_turns % 2 != 0;
    const std::int32_t a = 2 * i, b = a + 1, c = (2 * (i + 1) + (crossed ? 1 : 0)) % (2 * n), d = c ^ 1;
    sheet.triangles.row(2 * i) << a, c, b;
    sheet.triangles.row(2 * i + 1) << b, c, d;
  }
  return sheet;
}

/// A square with a third triangle at its right side that lies on the two.
inline Surface folded_back() {
  return with_triangles(square(2), {{2, 5, 5}}, {{1, 3, 4}});
}

/// A square whose right side goes on and comes back through it.
inline Surface crossing_itself() {
  return with_triangles(square(2), {{20, 0, 5}, {5, 5, -5}, {4, 4, 15}}, {{1, 4, 3}, {4, 5, 3}, {5, 6, 3}});
}

}  // namespace brainshift::test
