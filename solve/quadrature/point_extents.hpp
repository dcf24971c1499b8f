// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "discretise/interface/background_cells.hpp"
#include "solve/quadrature/integration_points.hpp"

namespace brainshift::solve {

/// What integration points stand for along a direction, one entry a point, mm.
struct PointExtents {
  std::vector<double> middle;  ///< X·d
  std::vector<double> edge;
};

/// Each point stands for a box of its cell's shape, turned as the direction: with σ² the variance of X·d over the cell,
/// v the point's volume, V the cell's and n the dimensions, its edge along d is √12 σ (v/V)^(1/n). The points of a cell
/// that they fill lie about its middle so that their boxes have σ² together: Gauss's points of a brick stand for its
/// octants. Other points are the middles of what they stand for. direction: of unit length.
PointExtents extents_along(const Eigen::Vector3d& direction, const BackgroundCells& cells,
                           const IntegrationPoints& points);

}  // namespace brainshift::solve
