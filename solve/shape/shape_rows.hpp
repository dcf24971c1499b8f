// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace brainshift::solve {

/// The shape functions that do not vanish at one point.
struct ShapeRow {
  std::span<const std::int32_t> node;  ///< the support
  std::span<const double> value;       ///< φ_a(x)
  std::span<const double> derivative;  ///< (support × 3) ∂φ_a/∂X_J, 1/mm; empty when not asked for

  std::size_t size() const { return node.size(); }
  /// ∂φ_a/∂X of the k-th node of the support.
  Eigen::Map<const Eigen::Vector3d> gradient(std::size_t k) const {
    return Eigen::Map<const Eigen::Vector3d>(derivative.data() + 3 * k);
  }
};

/// Shape functions at many points, compressed rows: row i holds the support of point i.
struct ShapeRows {
  std::vector<std::int64_t> begin = {0};  ///< (points + 1) offsets into the arrays below
  std::vector<std::int32_t> node;         ///< supporting node
  std::vector<double> value;              ///< φ_a(x_i)
  std::vector<double> derivative;         ///< (pairs × 3) ∂φ_a/∂X_J, 1/mm; empty when not asked for
  std::size_t grown = 0;                  ///< points whose support had to be grown until it was admissible

  std::size_t size() const { return begin.size() - 1; }
  ShapeRow operator[](std::size_t point) const {
    const auto first = static_cast<std::size_t>(begin[point]);
    const auto count = static_cast<std::size_t>(begin[point + 1]) - first;
    return {std::span(node).subspan(first, count), std::span(value).subspan(first, count),
            derivative.empty() ? std::span<const double>() : std::span(derivative).subspan(3 * first, 3 * count)};
  }
  void append(const ShapeRow& row) {
    node.insert(node.end(), row.node.begin(), row.node.end());
    value.insert(value.end(), row.value.begin(), row.value.end());
    derivative.insert(derivative.end(), row.derivative.begin(), row.derivative.end());
    begin.push_back(static_cast<std::int64_t>(node.size()));
  }
};

/// Some of the rows, in the order of `which`.
inline ShapeRows rows_at(const ShapeRows& rows, std::span<const std::int32_t> which) {
  ShapeRows some;
  for (const std::int32_t row : which) {
    some.append(rows[static_cast<std::size_t>(row)]);
  }
  return some;
}

/// The rows with these, ascending, replaced by others; rows beyond the old ones are appended.
inline ShapeRows with_rows(const ShapeRows& rows, std::span<const std::int32_t> which, const ShapeRows& others) {
  ShapeRows joined;  // rows may be most of what a body holds: never twice what they take
  joined.begin.reserve(rows.begin.size() + which.size());
  joined.node.reserve(rows.node.size() + others.node.size());
  joined.value.reserve(rows.value.size() + others.value.size());
  joined.derivative.reserve(rows.derivative.size() + others.derivative.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool replaced = next < which.size() && which[next] == static_cast<std::int32_t>(i);
    joined.append(replaced ? others[next] : rows[i]);
    next += replaced ? 1 : 0;
  }
  for (; next < which.size(); ++next) {
    joined.append(others[next]);
  }
  joined.grown = rows.grown + others.grown;
  return joined;
}

}  // namespace brainshift::solve
