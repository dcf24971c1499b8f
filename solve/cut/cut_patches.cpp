// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/cut_patches.hpp"

#include <algorithm>
#include <span>

namespace brainshift::solve {

namespace {

bool near_cut(const Visibility& visibility, const Points& positions, std::span<const std::int32_t> points) {
  const Eigen::Vector3d first = positions.row(points[0]);
  double reach = 0;
  for (const std::int32_t p : points) {
    reach = std::max(reach, (positions.row(p).transpose() - first).norm());
  }
  return visibility.near(first, reach);
}

/// Appends the points in groups of those that see each other.
void append_groups(const Visibility& visibility, const Points& positions, std::vector<std::int32_t> left,
                   PressurePatches& out) {
  while (!left.empty()) {
    const auto begin = static_cast<std::size_t>(out.order.size());
    out.order.push_back(left.front());
    left.erase(left.begin());
    for (std::size_t i = begin; i < out.order.size(); ++i) {
      const Eigen::Vector3d x = positions.row(out.order[i]);
      const auto seen = std::stable_partition(
          left.begin(), left.end(), [&](std::int32_t p) { return visibility.detour(x, positions.row(p)).has_value(); });
      out.order.insert(out.order.end(), seen, left.end());
      left.erase(seen, left.end());
    }
    out.begin.push_back(static_cast<std::int32_t>(out.order.size()));
  }
}

}  // namespace

PressurePatches part_patches(const Visibility& visibility, const Points& positions, const PressurePatches& patches) {
  PressurePatches out;
  out.begin.push_back(0);
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const auto first = patches.order.begin() + patches.begin[i], last = patches.order.begin() + patches.begin[i + 1];
    if (near_cut(visibility, positions, {first, last})) {
      append_groups(visibility, positions, {first, last}, out);
    } else {
      out.order.insert(out.order.end(), first, last);
      out.begin.push_back(static_cast<std::int32_t>(out.order.size()));
    }
  }
  return out;
}

}  // namespace brainshift::solve
