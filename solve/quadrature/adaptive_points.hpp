// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/quadrature/cell_points.hpp"
#include "solve/quadrature/integration_points.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift::solve {

struct AdaptivePoints {
  IntegrationPoints points;
  ShapeRows rows;          ///< of the points, with derivatives
  std::size_t capped = 0;  ///< points that missed the tolerance: at the depth, or the inside part of an octant
};

/// How cells are split.
struct AdaptiveRule {
  double tolerance = 0.1;   ///< τ
  int depth = 3;            ///< times a cell is split at most
  int points_per_part = 1;  ///< as of a cell, integration_points()
};

/// Adaptive integration (Wittek et al., section 3; METHOD.md (17)): a cell is split until the integral of the
/// derivatives of its shape functions, Q = Σ w ∂φ_a/∂X over all its nodes a, changes little, |Q_parts − Q| ≤ τ
/// |Q_parts|, at most `depth` times. The parts that were compared are the result, so little is evaluated in vain. Of a
/// cut hexahedron the octants that are not whole stay as they are, with one point. Tissues as of take_tissues().
/// Throws std::invalid_argument when the cells do not take so many points a part, or over 3 million are needed.
AdaptivePoints adaptive_points(const BackgroundCells& cells, const ShapeFunctions& shape, const AdaptiveRule& rule,
                               const LabelMap* labels, const std::vector<std::int32_t>& tissues);

}  // namespace brainshift::solve
