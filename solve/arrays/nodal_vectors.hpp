// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "solve/arrays/shared_work.hpp"

namespace brainshift::solve {

/// Vectors at nodes, four doubles each (x, y, z, unused), so that a node is one load of a vector register.
using NodalVectors = std::vector<double>;

inline Eigen::Map<const Eigen::Vector4d> at(const NodalVectors& v, std::size_t node) {
  return Eigen::Map<const Eigen::Vector4d>(v.data() + 4 * node);
}
inline Eigen::Map<Eigen::Vector4d> at(NodalVectors& v, std::size_t node) {
  return Eigen::Map<Eigen::Vector4d>(v.data() + 4 * node);
}

/// Sums term(node) over the nodes with all threads, in an order that does not depend on their number.
/// zero: the sum over none, where terms are no numbers.
template <class Term, class Sum = double>
Sum sum_over_nodes(std::size_t nodes, const Term& term, const Sum& zero = 0.0) {
  constexpr std::size_t chunks = 64;
  std::array<Sum, chunks> partial;
  const auto chunks_a_part = static_cast<std::int64_t>(chunks * nodes_a_part / std::max<std::size_t>(nodes, 1)) + 1;
  share_work(chunks, chunks_a_part, [&](std::int64_t i) {
    const auto c = static_cast<std::size_t>(i);
    Sum sum = zero;
    for (std::size_t a = c * nodes / chunks; a < (c + 1) * nodes / chunks; ++a) {
      sum += term(a);
    }
    partial[c] = sum;
  });
  return std::accumulate(partial.begin(), partial.end(), zero);
}

/// Largest |component| of a − b; NaN where one is.
inline double largest_difference(const NodalVectors& a, const NodalVectors& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double moved = std::abs(a[i] - b[i]);
    largest = moved <= largest ? largest : moved;  // a NaN stays
  }
  return largest;
}

/// Largest |a_i − b_i| of a node; NaN where one is.
inline double longest_difference(const NodalVectors& a, const NodalVectors& b) {
  double longest = 0;
  for (std::size_t i = 0; i < a.size() / 4; ++i) {
    const double moved = (at(a, i) - at(b, i)).squaredNorm();
    longest = moved <= longest ? longest : moved;  // a NaN stays
  }
  return std::sqrt(longest);
}

/// Largest |component|.
inline double largest_component(const NodalVectors& v) {
  return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size())).lpNorm<Eigen::Infinity>();
}

}  // namespace brainshift::solve
