// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/touched_rows.hpp"

#include <algorithm>

namespace brainshift::solve {

namespace {

/// One row after another, of two sets of rows.
class Joined {
 public:
  void append(const ShapeRows& from, std::size_t row) {
    const auto first = from.begin[row], last = from.begin[row + 1];
    rows_.node.insert(rows_.node.end(), from.node.begin() + first, from.node.begin() + last);
    rows_.value.insert(rows_.value.end(), from.value.begin() + first, from.value.begin() + last);
    if (!from.derivative.empty()) {
      rows_.derivative.insert(rows_.derivative.end(), from.derivative.begin() + 3 * first,
                              from.derivative.begin() + 3 * last);
    }
    rows_.begin.push_back(static_cast<std::int64_t>(rows_.node.size()));
  }
  ShapeRows take(std::size_t grown) {
    rows_.grown = grown;
    return std::move(rows_);
  }

 private:
  ShapeRows rows_{.begin = {0}, .node = {}, .value = {}, .derivative = {}, .grown = 0};
};

}  // namespace

std::vector<std::int32_t> touched_rows(const ShapeRows& rows, const Points& points, const Advance& advance) {
  std::vector<std::uint8_t> changed(static_cast<std::size_t>(advance.positions.rows()), 0);
  for (const std::int32_t a : advance.nodes) {
    changed[static_cast<std::size_t>(a)] = 1;
  }
  const auto count = static_cast<std::int64_t>(rows.size());
  std::vector<std::uint8_t> touched(rows.size(), 0);
#pragma omp parallel for schedule(static)
  for (std::int64_t i = 0; i < count; ++i) {
    const Eigen::Vector3d x = points.row(i);
    double reach = 0, radius = 0;
    bool found = false;
    for (std::int64_t k = rows.begin[static_cast<std::size_t>(i)]; k < rows.begin[static_cast<std::size_t>(i) + 1];
         ++k) {
      const auto a = static_cast<std::size_t>(rows.node[static_cast<std::size_t>(k)]);
      found = found || changed[a] != 0;
      reach = std::max(reach, (advance.positions.row(static_cast<Eigen::Index>(a)).transpose() - x).norm());
      radius = std::max(radius, advance.radius[a]);
    }
    found = found || advance.fresh.near(x, std::max(reach, radius));
    touched[static_cast<std::size_t>(i)] =
        found || std::any_of(advance.nodes.begin(), advance.nodes.end(), [&](std::int32_t a) {
          return (advance.positions.row(a).transpose() - x).norm() < advance.radius[static_cast<std::size_t>(a)];
        });
  }
  std::vector<std::int32_t> list;
  for (std::size_t i = 0; i < touched.size(); ++i) {
    if (touched[i] != 0) {
      list.push_back(static_cast<std::int32_t>(i));
    }
  }
  return list;
}

ShapeRows with_rows(const ShapeRows& rows, std::span<const std::int32_t> which, const ShapeRows& others) {
  Joined joined;
  std::size_t next = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (next < which.size() && which[next] == static_cast<std::int32_t>(i)) {
      joined.append(others, next++);
    } else {
      joined.append(rows, i);
    }
  }
  while (next < which.size()) {
    joined.append(others, next++);
  }
  return joined.take(rows.grown + others.grown);
}

}  // namespace brainshift::solve
