// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>

#include "solve/interface/model.hpp"

namespace examples {

/// A cube of 40 mm, bonded to two plates that press it by 4 mm along z: nodes on a grid of 5 mm, moved a little so that
/// it is irregular inside, and 8 × 8 × 8 hexahedra. Without a material.
inline brainshift::solve::Model pressed_cube() {
  constexpr int n = 8;
  constexpr double edge = 40, step = edge / n, pressed = 4;
  brainshift::solve::Model model;
  auto& cloud = model.cloud;
  const int nodes = (n + 1) * (n + 1) * (n + 1);
  cloud.positions.resize(nodes, 3);
  model.conditions.displacement.setConstant(nodes, 3, std::numeric_limits<double>::quiet_NaN());
  for (int a = 0; a < nodes; ++a) {
    const int i = a % (n + 1), j = a / (n + 1) % (n + 1), k = a / (n + 1) / (n + 1);
    const auto inner = [](int index) { return index > 0 && index < n; };
    const bool inside = inner(i) && inner(j) && inner(k);
    const double shift = inside ? 0.2 * step * std::sin(7.0 * a) : 0;
    cloud.positions.row(a) << i * step + shift, j * step - shift, k * step + shift / 2;
    cloud.spacing.push_back(step);
    cloud.on_surface.push_back(inside ? 0 : 1);
    if (k == 0 || k == n) {
      model.conditions.displacement.row(a) << 0, 0, k == n ? -pressed : 0.0;
    }
  }
  auto& cells = model.cells;
  cells.vertices.resize(nodes, 3);
  for (int a = 0; a < nodes; ++a) {
    cells.vertices.row(a) << a % (n + 1) * step, a / (n + 1) % (n + 1) * step, a / (n + 1) / (n + 1) * step;
  }
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const int low = (k * (n + 1) + j) * (n + 1) + i, across = n + 1, up = (n + 1) * (n + 1);
        for (const int layer : {low, low + up}) {
          for (const int corner : {layer, layer + 1, layer + across + 1, layer + across}) {
            cells.connectivity.push_back(corner);
          }
        }
        cells.inside_fraction.push_back(1);
        cells.label.push_back(1);
      }
    }
  }
  return model;
}

}  // namespace examples
