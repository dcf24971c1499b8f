// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

#include "segmentation/geometry/points.hpp"
#include "solve/arrays/nodal_vectors.hpp"
#include "solve/shape/shape_rows.hpp"

namespace brainshift::solve {

/// Carries parameters over to a body that was cut further. Those of the nodes near the cut are chosen such that the
/// displacement at these nodes and its gradient at the integration points near are, in the sense of least squares, what
/// they were; the others stay.
class Matching {
 public:
  /// nodes: whose parameters are chosen, new ones too; count: of all nodes now.
  Matching(std::vector<std::int32_t> nodes, std::size_t count);

  /// Rows, before the cut and after it, whose values are to agree. First those at the nodes themselves: what hardly any
  /// row sees of a node is held near its displacement.
  void agree_in_value(const ShapeRows& before, const ShapeRows& after);
  /// The same for derivatives, times a length, mm.
  void agree_in_gradient(const ShapeRows& before, const ShapeRows& after, double length);

  /// To be called when all rows are there. Throws TooFewNodes where they do not determine the parameters.
  void factorise();

  NodalVectors operator()(const NodalVectors& before) const;

 private:
  using Entries = std::vector<Eigen::Triplet<double>>;
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  std::vector<std::int32_t> nodes_;
  std::vector<Eigen::Index> unknown_;  ///< of each node, or none
  Eigen::Index rows_ = 0;
  double pull_ = 0;
  Entries before_entries_, after_entries_;
  Matrix before_, after_, chosen_;  ///< chosen: the columns of `after` that belong to nodes_
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace brainshift::solve
