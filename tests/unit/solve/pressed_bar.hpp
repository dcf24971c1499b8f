// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <random>

#include "tests/unit/solve/models.hpp"

namespace brainshift::solve {

/// A bar of 8 × 8 × 20 spacings, or a shorter one, held on its surface from the seventh on and pressed in at the middle
/// of the near end: what moves is near.
inline Model pressed_bar(int length = 20) {
  constexpr double h = 5;
  const Eigen::Vector3i steps(8, 8, length);
  const Eigen::Vector3d size = h * steps.cast<double>();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> within(-0.25 * h, 0.25 * h);
  Model model;
  NodeCloud& cloud = model.cloud;
  const Eigen::Index nodes = (steps.array() + 1).prod();
  cloud.positions.resize(nodes, 3);
  Points& prescribed = model.conditions.displacement;
  prescribed = Points::Constant(nodes, 3, std::nan(""));
  for (Eigen::Index a = 0; a < nodes; ++a) {
    const Eigen::Vector3i i(static_cast<int>(a % 9), static_cast<int>(a / 9 % 9), static_cast<int>(a / 81));
    bool on_surface = false;
    for (int axis = 0; axis < 3; ++axis) {
      const bool at_face = i[axis] == 0 || i[axis] == steps[axis];
      on_surface = on_surface || at_face;
      cloud.positions(a, axis) = h * i[axis] + (at_face ? 0 : within(random));
    }
    cloud.on_surface.push_back(on_surface ? 1 : 0);
    if (on_surface && i.z() > 6) {
      prescribed.row(a).setZero();
    } else if (const int r = (i.head<2>().array() - 4).square().sum(); i.z() == 0 && r <= 9) {
      prescribed.row(a) << 0, 0, 4 * (1 - r / 16.0);
    }
  }
  cloud.spacing.assign(cloud.on_surface.size(), h);
  model.cells = test::box_cells(steps, size);
  model.materials[1] = {3000, 0.4, 1000};
  return model;
}

inline double largest_difference_of(const SolveResult& a, const SolveResult& b) {
  return (a.solution.displacement - b.solution.displacement).rowwise().norm().maxCoeff();
}

}  // namespace brainshift::solve
