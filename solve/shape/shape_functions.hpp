// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <span>

#include "segmentation/geometry/points.hpp"
#include "solve/interface/shape_options.hpp"
#include "solve/shape/shape_rows.hpp"
#include "solve/shape/visibility.hpp"

namespace brainshift::solve {

struct NodeSupports;

/// The shape functions of a cloud: prepared once (search tree), evaluated anywhere. Cheap to copy; const calls may run
/// on many threads.
class ShapeFunctions {
 public:
  /// positions (n × 3) mm, spacing one a node, mm. visibility: of a cut, or none. A node that it hides counts as at the
  /// distance s (l/s)⁴, s in a straight line and l over the cut's front: the diffraction method (Organ et al. 1996), by
  /// which shape functions are continuous but across the cut. Throws std::invalid_argument when there are fewer nodes
  /// than the basis needs, and, naming the node, when the basis is planar and a node's z is not 0.
  ShapeFunctions(const Points& positions, std::span<const double> spacing, const ShapeOptions& options,
                 std::shared_ptr<const Visibility> visibility = nullptr);

  /// Values, and derivatives if asked, at points (m × 3). Uses all threads; the result does not depend on their number.
  /// Of a planar basis the derivatives by z are exactly 0. Throws std::invalid_argument, naming the point, where no
  /// support is admissible (all nodes in one plane; planar: on one line) or, planar, where z is not 0.
  ShapeRows evaluate(const Points& points, bool with_derivatives) const;

  /// The same where a support is admissible of which radii have grown to at most so many times; the rows of other
  /// points are empty.
  ShapeRows evaluate_where_admissible(const Points& points, bool with_derivatives, double largest_growth) const;

  /// The field Σφ_a(x) values_a at points (m × 3); values (n × 3). What evaluate() and a product would give, without
  /// the rows in memory.
  Points interpolate(const Points& points, const Points& values) const;

  std::size_t nodes() const;

 private:
  std::shared_ptr<const NodeSupports> supports_;
};

/// û from u: solves Σ_b φ_b(X_a) û_b = u_a at all nodes. displacement (n × 3), mm. Afterwards
/// shape.interpolate(x, û) is the displacement field that the solver had.
/// Throws std::runtime_error when the iteration does not reach 1e-9 of the largest displacement.
Points parameters_from_displacement(const ShapeFunctions& shape, const Points& positions, const Points& displacement);
/// The same with φ_b(X_a) as a matrix, for many displacements.
Points parameters_from_displacement(const Eigen::SparseMatrix<double, Eigen::RowMajor>& shape,
                                    const Points& displacement);

}  // namespace brainshift::solve
