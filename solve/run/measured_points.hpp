// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solve/measured/response.hpp"
#include "solve/run/thinned_body.hpp"

namespace brainshift::solve {

Points stacked(const Points& above, const Points& below);

/// Places so far outside a thinned body that no node sees them move to the nearest node: nothing is said there that
/// anyone uses. Within the body the nearest node is about a spacing off.
Points within_sight(Points places, const NodeCloud& cloud);

/// What is measured, the points of the cortex first.
struct Seen {
  Points positions, displacement, sigma;

  explicit Seen(const Measurement& m)
      : positions(stacked(m.cortex, m.inner)),
        displacement(stacked(m.cortex_displacement, m.inner_displacement)),
        sigma(stacked(m.sigma, m.inner_sigma)) {}
};

/// What a fit is made on: the thinned body, and what is measured, spread out first.
struct MeasuredPoints {
  const ThinnedBody& thinned;
  Conditions conditions;  ///< at its nodes
  ShapeFunctions shape;
  std::vector<Eigen::Index> row;          ///< of Seen
  Points positions, displacement, sigma;  ///< of these

  /// all: conditions at the nodes of the whole cloud.
  MeasuredPoints(const ThinnedBody& body, const Conditions& all);

  /// How what the rows see answers forces; places: where that lies, the measured points first.
  Response response(const ShapeRows& rows, const Points& places) const;

  /// The same with a smooth motion of the opening, which moves its points as they were measured, and all else as the
  /// body carries it. None where the body is free and the registration is unknown, which would share it, where the
  /// weight of a known one is given, or all points of the cortex lie in one place. One fades where there is one
  /// opening.
  Response response_and_motion(const ShapeRows& rows, const Points& places) const;
};

}  // namespace brainshift::solve
