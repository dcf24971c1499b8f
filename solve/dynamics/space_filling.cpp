// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/space_filling.hpp"

#include <algorithm>
#include <numeric>

namespace brainshift::solve {

namespace {

/// Spreads the low 21 bits of x so that two zero bits follow each.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

}  // namespace

std::vector<std::int32_t> space_filling_order(const Points& points) {
  std::vector<std::int32_t> order(static_cast<std::size_t>(points.rows()));
  std::iota(order.begin(), order.end(), 0);
  if (order.empty()) {
    return order;
  }
  const Eigen::RowVector3d low = points.colwise().minCoeff();
  const double extent = (points.colwise().maxCoeff() - low).maxCoeff();
  const double cells = 2097151.0 / (extent > 0 ? extent : 1.0);
  std::vector<std::uint64_t> key(order.size());
  for (std::size_t i = 0; i < key.size(); ++i) {
    const Eigen::RowVector3d grid = (points.row(static_cast<Eigen::Index>(i)) - low) * cells;
    key[i] = spread(static_cast<std::uint64_t>(grid[0])) | spread(static_cast<std::uint64_t>(grid[1])) << 1 |
             spread(static_cast<std::uint64_t>(grid[2])) << 2;
  }
  std::stable_sort(order.begin(), order.end(), [&key](std::int32_t a, std::int32_t b) {
    return key[static_cast<std::size_t>(a)] < key[static_cast<std::size_t>(b)];
  });
  return order;
}

}  // namespace brainshift::solve
