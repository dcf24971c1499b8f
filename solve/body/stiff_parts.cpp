// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/body/stiff_parts.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "segmentation/geometry/joined_nodes.hpp"

namespace brainshift::solve {

namespace {

constexpr std::size_t fewest = 8;     // nodes of a part
constexpr double most_of_body = 0.9;  // of all nodes

/// Which step of stiffness each value is on: the first is that of the softest tissue, and each begins thirty times
/// higher than the one below.
class Levels {
 public:
  explicit Levels(std::span<const double> of_point) {
    std::vector<double> sorted(of_point.begin(), of_point.end());
    std::ranges::sort(sorted);
    for (const double modulus : sorted) {
      if (begin_.empty() || modulus >= nearly_rigid * begin_.back()) {
        begin_.push_back(modulus);
      }
    }
  }

  bool one() const { return begin_.size() < 2; }

  /// From 0; -1 of what no point is of.
  int of(double modulus) const {
    return std::isfinite(modulus) ? static_cast<int>(std::ranges::upper_bound(begin_, modulus) - begin_.begin()) - 1
                                  : -1;
  }

 private:
  std::vector<double> begin_;
};

}  // namespace

std::vector<std::vector<std::int32_t>> stiff_parts(std::span<const double> of_point, std::span<const double> of_node,
                                                   const ShapeRows& rows, std::span<const std::uint8_t> held) {
  const Levels levels(of_point);
  if (levels.one()) {
    return {};
  }
  JoinedNodes joined(of_node.size());
  const auto level_of_node = [&](std::int32_t a) { return levels.of(of_node[static_cast<std::size_t>(a)]); };
  for (std::size_t p = 0; p < rows.size(); ++p) {
    const int level = levels.of(of_point[p]);
    std::int32_t last = -1;
    for (const std::int32_t a : rows[p].node) {
      if (level > 0 && level_of_node(a) == level) {
        if (last >= 0) {
          joined.join(last, a);
        }
        last = a;
      }
    }
  }
  std::map<std::int32_t, std::vector<std::int32_t>> by_root;
  for (std::int32_t a = 0; a < static_cast<std::int32_t>(of_node.size()); ++a) {
    if (level_of_node(a) > 0) {
      by_root[joined.root(a)].push_back(a);
    }
  }
  std::vector<std::vector<std::int32_t>> parts;
  for (auto& [root, nodes] : by_root) {
    const bool is_held =
        std::ranges::any_of(nodes, [&](std::int32_t a) { return held[static_cast<std::size_t>(a)] != 0; });
    const bool is_body = static_cast<double>(nodes.size()) > most_of_body * static_cast<double>(of_node.size());
    if (nodes.size() >= fewest && !is_held && !is_body) {
      parts.push_back(std::move(nodes));
    }
  }
  std::ranges::sort(parts, [](const auto& a, const auto& b) {
    return a.size() != b.size() ? a.size() > b.size() : a.front() < b.front();
  });
  return parts;
}

}  // namespace brainshift::solve
