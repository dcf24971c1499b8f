// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "solve/shape/shape_functions.hpp"

namespace brainshift::solve {

/// φ of the given points among those of `rows`, in their order: one row a point, one column a node.
inline Eigen::SparseMatrix<double, Eigen::RowMajor> shape_matrix(const ShapeRows& rows,
                                                                 std::span<const std::int32_t> points,
                                                                 Eigen::Index nodes) {
  Eigen::SparseMatrix<double, Eigen::RowMajor> shape(static_cast<Eigen::Index>(points.size()), nodes);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ShapeRow row = rows[static_cast<std::size_t>(points[i])];
    for (std::size_t k = 0; k < row.size(); ++k) {
      entries.emplace_back(static_cast<int>(i), row.node[k], row.value[k]);
    }
  }
  shape.setFromTriplets(entries.begin(), entries.end());
  return shape;
}

/// φ of all points of `rows`.
inline Eigen::SparseMatrix<double, Eigen::RowMajor> shape_matrix(const ShapeRows& rows, Eigen::Index nodes) {
  std::vector<std::int32_t> all(rows.size());
  std::iota(all.begin(), all.end(), 0);
  return shape_matrix(rows, all, nodes);
}

}  // namespace brainshift::solve
