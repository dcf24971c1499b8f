// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "solve/shape/visibility.hpp"
#include "solve/solve.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::test {

/// A path through corners, with a tip at its end or without.
inline solve::CutFacets path(const std::vector<std::pair<double, double>>& corners, bool tip) {
  solve::CutFacets cut;
  cut.planar = true;
  const auto n = static_cast<std::int32_t>(corners.size());
  cut.vertices.resize(n, 3);
  cut.facets.resize(n - 1, 3);
  for (std::int32_t i = 0; i < n; ++i) {
    const auto& [x, y] = corners[static_cast<std::size_t>(i)];
    cut.vertices.row(i) << x, y, 0;
    if (i + 1 < n) {
      cut.facets.row(i) << i, i + 1, -1;
    }
  }
  if (tip) {
    cut.front.push_back({n - 1, n - 1});
  }
  return cut;
}

/// Two triangles in the plane y = 0 from x = 0 to a front at `length`, z from -9 to 9; the normal along y.
inline solve::CutFacets sheet_along_x(double length) {
  solve::CutFacets cut;
  cut.vertices.resize(4, 3);
  cut.vertices << 0, 0, -9, length, 0, -9, length, 0, 9, 0, 0, 9;
  cut.facets.resize(2, 3);
  cut.facets << 0, 2, 1, 0, 3, 2;
  cut.front.push_back({1, 2});
  return cut;
}

inline solve::Cut cut_path(const std::vector<std::pair<double, double>>& corners,
                           const std::vector<double>& time = {}) {
  return {"cut", path(corners, false).vertices, Triangles(0, 3), time};
}

inline solve::SolveOptions plane_options() {
  solve::SolveOptions options;
  options.points_per_cell = 4;
  return options;
}

constexpr double strip_length = 30, strip_width = 20;

/// A strip in plane strain of 16 × 11 nodes, pulled along x between frictionless plates: stretched evenly.
inline solve::Model strip(double stretch, solve::Plane plane = solve::Plane::strain) {
  solve::Model model;
  model.plane = plane;
  model.cloud = irregular_rectangle(16, 11, strip_length, strip_width);
  model.conditions = test::all_free(model.cloud);
  model.cells = rectangle_cells(16, 11, strip_length, strip_width);
  model.materials[1] = {3000, 0.45, 1000};
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const double x = model.cloud.positions(a, 0);
    auto prescribed = model.conditions.displacement.row(a);
    if (x == 0 || x == strip_length) {
      prescribed[0] = x == 0 ? 0 : (stretch - 1) * strip_length;
    }
    if (x == 0 && model.cloud.positions(a, 1) == 0) {
      prescribed[1] = 0;
    }
  }
  return model;
}

}  // namespace brainshift::test
