// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "solve/quadrature/gauss_points.hpp"
#include "solve/quadrature/integration_points.hpp"

namespace brainshift::solve {

/// Positions and volumes of the points; cells and labels stay as they are.
inline void place_points(std::span<const WeightedPoint> points, IntegrationPoints& result) {
  result.positions.resize(std::ssize(points), 3);
  result.volume.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    result.positions.row(static_cast<Eigen::Index>(i)) = points[i].position;
    result.volume.push_back(points[i].volume);
  }
}

}  // namespace brainshift::solve
