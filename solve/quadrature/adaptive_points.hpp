// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/quadrature/integration_points.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift::solve {

struct AdaptivePoints {
  IntegrationPoints points;
  ShapeRows rows;          ///< of the points, with derivatives
  std::size_t capped = 0;  ///< points that missed the tolerance: at the depth, or the inside part of an octant
};

/// Adaptive integration (section 3 of the source): a cell is split until the integral of the derivatives of its shape
/// functions, Q = Σ w ∂φ_a/∂X over all its nodes a, changes little, |Q_parts − Q| ≤ τ |Q_parts|, at most `depth` times.
/// Each part has one point, and the parts that were compared are the result, so little is evaluated in vain. Of a cut
/// hexahedron the octants that are not whole stay as they are. Tissues as of integration_points().
/// Throws std::invalid_argument unless tolerance > 0 and depth is 1 to 6, and when it takes over 3 million points.
AdaptivePoints adaptive_points(const BackgroundCells& cells, const ShapeFunctions& shape, double tolerance, int depth,
                               const LabelMap* labels, const std::vector<std::int32_t>& tissues);

}  // namespace brainshift::solve
