// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solve/boundary/essential_conditions.hpp"
#include "solve/boundary/pushed_nodes.hpp"
#include "solve/device/clusters.hpp"

namespace brainshift::solve::device {

inline CompressedRows compressed(const EssentialConditions::RowMatrix& matrix) {
  CompressedRows rows;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (EssentialConditions::RowMatrix::InnerIterator entry(matrix, i); entry; ++entry) {
      rows.node.push_back(static_cast<std::int32_t>(entry.col()));
      rows.shape.push_back(entry.value());
    }
    rows.begin.push_back(static_cast<std::int64_t>(rows.node.size()));
  }
  return rows;
}

inline CompressedRows compressed(const PushedNodes& nodes) {
  CompressedRows rows;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const PushedNodes::Row row = nodes.row(i);
    rows.node.insert(rows.node.end(), row.node.begin(), row.node.end());
    rows.shape.insert(rows.shape.end(), row.shape.begin(), row.shape.end());
    rows.begin.push_back(static_cast<std::int64_t>(rows.node.size()));
  }
  return rows;
}

/// Row by row.
inline std::vector<double> entries_of(const Eigen::SparseMatrix<double>& matrix) {
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> full(matrix);
  return {full.data(), full.data() + full.size()};
}

}  // namespace brainshift::solve::device
