// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "segmentation/geometry/points.hpp"
#include "solve/arrays/nodal_vectors.hpp"
#include "solve/interface/model.hpp"
#include "solve/quadrature/integration_points.hpp"
#include "solve/shape/shape_rows.hpp"

namespace brainshift::solve {

/// Forces on the parameters, µN, by the fraction of the load.
class ExternalForce {
 public:
  ExternalForce() = default;
  /// In proportion to the fraction; full: under the whole load, or empty: none.
  explicit ExternalForce(NodalVectors full);
  /// Between equally spaced fractions from 0 to 1 in straight lines, and on along the last: not in proportion.
  explicit ExternalForce(std::vector<NodalVectors> at_fractions);

  bool empty() const { return at_.empty(); }
  /// Under the whole load; none where empty().
  const NodalVectors& full() const { return at_.back(); }
  /// At equal steps of the fraction, the last at 1; none where empty().
  const std::vector<NodalVectors>& at_fractions() const { return at_; }
  /// force −= that at the fraction.
  void subtract(double fraction, NodalVectors& force) const;
  /// Work, 1e-9 J, between two parameters while the fraction goes from one to another.
  double work(double from, double to, const NodalVectors& start, const NodalVectors& end) const;

 private:
  std::vector<NodalVectors> at_;  // at equal steps of the fraction, without that at 0, which is no force
};

/// Adds the forces of point loads, N, spread as virtual work has it: Vᵀ f, V the shape functions at their places, which
/// may be the nodes. force (places × 3); total in µN, 4 a node.
void add_point_forces(const Points& force, const ShapeRows& rows, NodalVectors& total);

/// Adds f_a = Σ_I w φ_a(X_I) b(X_I).
void add_body_force(const BodyForce& body_force, const IntegrationPoints& points, const ShapeRows& rows,
                    NodalVectors& total);

}  // namespace brainshift::solve
