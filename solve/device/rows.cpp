// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/device/rows.hpp"

#include <cmath>

namespace brainshift::solve::device {

CompressedRows rows_of(const EssentialConditions::RowMatrix& matrix) {
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

CompressedRows rows_of(const PushedNodes& nodes) {
  CompressedRows rows;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const PushedNodes::Row row = nodes.row(i);
    rows.node.insert(rows.node.end(), row.node.begin(), row.node.end());
    rows.shape.insert(rows.shape.end(), row.shape.begin(), row.shape.end());
    rows.begin.push_back(static_cast<std::int64_t>(rows.node.size()));
  }
  return rows;
}

std::vector<double> entries_of(const Eigen::SparseMatrix<double>& matrix) {
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> full(matrix);
  return {full.data(), full.data() + full.size()};
}

void put_rows(const CompressedRows& rows, Memory& memory, SparseRows& to) {
  const NodeRows moved = by_node(rows);
  to.count = static_cast<std::int32_t>(rows.begin.size() - 1);
  to.begin = memory.put(rows.begin);
  to.node = memory.put(rows.node);
  to.shape = memory.put(rows.shape);
  to.moved = static_cast<std::int32_t>(moved.node.size());
  to.moved_node = memory.put(moved.node);
  to.moved_begin = memory.put(moved.begin);
  to.moved_row = memory.put(moved.row);
  to.moved_shape = memory.put(moved.shape);
}

void put_nodes(const Contact& contact, std::size_t nodes, Memory& memory, NodesInSkull& to) {
  const CompressedRows rows = rows_of(contact.nodes());
  put_rows(rows, memory, to);
  std::vector<double> column_sum(nodes, 0.0);
  for (std::size_t k = 0; k < rows.node.size(); ++k) {
    column_sum[static_cast<std::size_t>(rows.node[k])] += std::abs(rows.shape[k]);
  }
  const Points& position = contact.nodes().positions();
  to.position = memory.put(std::vector<double>(position.data(), position.data() + position.size()));
  to.allowed = memory.put(std::vector<double>(contact.allowed().begin(), contact.allowed().end()));
  to.column_sum = memory.put(column_sum);
}

}  // namespace brainshift::solve::device
