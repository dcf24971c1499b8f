// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::solve {

/// A square in plane strain that is pulled open across a cut from its left side to x = 30.
inline Model pulled_square() {
  constexpr double side = 60;
  Model model;
  model.cloud = test::irregular_rectangle(21, 21, side, side);
  model.conditions = test::all_free(model.cloud);
  model.cells = test::rectangle_cells(20, 20, side, side);
  model.materials[1] = {3000, 0.45, 1000};
  model.plane = Plane::strain;
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const double y = model.cloud.positions(a, 1);
    if (y < 1e-9 || y > side - 1e-9) {
      model.conditions.displacement.row(a) << 0, y > 1 ? 6 : 0, std::nan("");
    }
  }
  Cut cut;
  cut.name = "path";
  cut.vertices.resize(2, 3);
  cut.vertices << -5, 30, 0, 30, 30, 0;
  model.cuts = {cut};
  return model;
}

}  // namespace brainshift::solve
