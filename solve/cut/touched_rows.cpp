// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/touched_rows.hpp"

#include <algorithm>

namespace brainshift::solve {

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
    for (const std::int32_t node : rows[static_cast<std::size_t>(i)].node) {
      const auto a = static_cast<std::size_t>(node);
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

}  // namespace brainshift::solve
