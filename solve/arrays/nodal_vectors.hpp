// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

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
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < chunks; ++c) {
    Sum sum = zero;
    for (std::size_t a = c * nodes / chunks; a < (c + 1) * nodes / chunks; ++a) {
      sum += term(a);
    }
    partial[c] = sum;
  }
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

/// Largest |component|.
inline double largest_component(const NodalVectors& v) {
  return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size())).lpNorm<Eigen::Infinity>();
}

}  // namespace brainshift::solve
