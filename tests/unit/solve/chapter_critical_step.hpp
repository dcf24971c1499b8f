// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "solve/force/point_blocks.hpp"

namespace brainshift::solve {

/// The critical step as Wittek et al. print it, eq. 25, with (λ + 2µ)/ρ: min over points of 2 / (c_d sqrt(N Σ|B|²)), s.
/// wave_speed: c_d, mm/s, one a row of the material table; points in double precision. What the solver's own bound is
/// held against.
inline double chapter_critical_step(const PointBlocks& points, std::span<const double> wave_speed) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Patch& patch : points.patches) {
    const double c = wave_speed[static_cast<std::size_t>(patch.material)];
    for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
      const auto nodes = static_cast<Eigen::Index>(points.support_size(p));
      const Eigen::Map<const Eigen::Matrix3Xd> derivative(points.derivatives_of<double>(p), 3, nodes);
      smallest = std::min(smallest, 2 / (c * std::sqrt(static_cast<double>(nodes) * derivative.squaredNorm())));
    }
  }
  return smallest;
}

}  // namespace brainshift::solve
