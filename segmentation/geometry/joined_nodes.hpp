// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace brainshift {

/// Sets of nodes or vertices, at first of one node each, that are joined pair by pair.
class JoinedNodes {
 public:
  explicit JoinedNodes(std::size_t nodes) : parent_(nodes) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// The node that stands for the set of a.
  std::int32_t root(std::int32_t a) {
    while (parent(a) != a) {
      a = parent(a) = parent(parent(a));
    }
    return a;
  }

  /// The root of a stands for both sets from now on.
  void join(std::int32_t a, std::int32_t b) { parent(root(b)) = root(a); }

 private:
  std::int32_t& parent(std::int32_t a) { return parent_[static_cast<std::size_t>(a)]; }

  std::vector<std::int32_t> parent_;
};

}  // namespace brainshift
