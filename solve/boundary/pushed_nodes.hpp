// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segmentation/geometry/points.hpp"
#include "solve/arrays/nodal_vectors.hpp"
#include "solve/shape/shape_rows.hpp"

namespace brainshift::solve {

/// Nodes that something rigid puts back after a step. To move the places of nodes by δ the parameters change like in
/// the simplified EBCIEM, û ← û + M⁻¹Vᵀ D⁻¹ δ with D the row sums of |V| M⁻¹ |V|ᵀ. What remains is put back in the
/// following steps, so at rest it is a small part of the last step's motion.
class PushedNodes {
 public:
  /// nodes: those that may be pushed; what follows counts them in this order. positions (n × 3) of all nodes, mm; rows:
  /// shape functions at all of them.
  PushedNodes(const Points& positions, std::span<const std::int32_t> nodes, const ShapeRows& rows);

  std::size_t size() const { return inverse_row_sum_.size(); }

  /// Undeformed, mm, one row a node that may be pushed, and the shape functions there.
  const Points& positions() const { return positions_; }
  struct Row {
    std::span<const std::int32_t> node;
    std::span<const double> shape;
  };
  Row row(std::size_t i) const {
    const auto first = static_cast<std::size_t>(begin_[i]), size = static_cast<std::size_t>(begin_[i + 1]) - first;
    return {std::span(node_).subspan(first, size), std::span(shape_).subspan(first, size)};
  }

  /// Sets the nodal masses (one a node) that weigh the pushes.
  void weigh(std::span<const double> mass);

  /// D⁻¹, one a node that may be pushed, as weighed last.
  std::span<const double> inverse_row_sum() const { return inverse_row_sum_; }

  /// Where the i-th node is, mm.
  Eigen::Vector3d place(std::size_t i, const NodalVectors& parameters) const;

  /// Begins a step: work() counts the pushes from here on.
  void begin();

  /// To move the i-th node by so many mm along a unit vector; 0: leave it alone. Calls for different nodes may run on
  /// many threads.
  void set_push(std::size_t i, double length, const Eigen::Vector3d& direction);

  /// Moves the parameters by the pushes, all of which must have been set since the last time; again for each sweep.
  void apply(NodalVectors& parameters) const;

  /// Work of the step's pushes, times α: half their sum over the way from one step before the state that they were
  /// applied to, to one after. Negative: they brake.
  double work(const NodalVectors& before, const NodalVectors& after) const;

 private:
  Points positions_;
  std::vector<std::int64_t> begin_;  ///< V, compressed rows
  std::vector<std::int32_t> node_;
  std::vector<double> shape_;
  std::vector<double> inverse_mass_;     ///< one a node of the cloud
  std::vector<double> inverse_row_sum_;  ///< D⁻¹
  std::vector<double> push_;             ///< D⁻¹ δ, 3 a node
  std::vector<double> total_;            ///< of the step
};

}  // namespace brainshift::solve
