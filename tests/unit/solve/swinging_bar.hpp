// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <vector>

#include "solve/solve.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve {

/// A bar that is pulled suddenly along its length and swings through three periods of its first longitudinal mode.
struct SwingingBar {
  static constexpr double length = 60, modulus = 3000, density = 1000;

  double period = 4 * length / (1000 * std::sqrt(modulus / density));  ///< 4 L/c, s
  Model model = pulled(period);

  /// Of the bar's end through its place at rest, after 1/4, 3/4, ... of a period: there the cosines of all modes
  /// vanish.
  struct Passages {
    int count = 0;
    double last = 0;  ///< s
  };
  static Passages passages(const std::vector<Snapshot>& snapshots) {
    const double at_rest = density * length * length / (2 * modulus) * 1e-3;
    constexpr Eigen::Index end = 2 * 31 - 1;
    Passages found;
    double time_before = 0, before = -at_rest;
    for (const Snapshot& s : snapshots) {
      const double off = s.displacement(end, 0) - at_rest;
      if (off * before < 0) {
        found.last = time_before + (s.time - time_before) * before / (before - off);
        ++found.count;
      }
      before = off;
      time_before = s.time;
    }
    return found;
  }

 private:
  static Model pulled(double period) {
    Model model;
    model.plane = Plane::strain;  // without lateral strain, so as thin as any
    model.cloud = test::irregular_rectangle(31, 4, length, 6);
    model.conditions = test::all_free(model.cloud);
    model.cells = test::rectangle_cells(30, 3, length, 6);
    model.materials[1] = {
        .youngs_modulus = modulus, .poisson_ratio = 0, .density = density, .law = Law::linear_elastic};
    for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
      if (model.cloud.positions(a, 0) < 1e-9) {
        model.conditions.displacement(a, 0) = 0;
      }
    }
    model.gravity = {1, 0, 0};
    model.curve = LoadCurve({0, 1e-6, 3 * period}, {0, 1, 1}, LoadCurve::Join::straight);
    return model;
  }
};

}  // namespace brainshift::solve
