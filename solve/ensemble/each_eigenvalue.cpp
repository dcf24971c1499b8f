// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble/each_eigenvalue.hpp"

#include <cmath>

#include "solve/force/largest_eigenvalue.hpp"

namespace brainshift::solve {

Numbers bound_tightness_of_each(EachForce& force, const EachNumbers& bound) {
  const std::size_t nodes = bound.size();
  EachVectors mode(nodes), resistance(nodes);
  const NodalVectors start = rough_mode(nodes);
  for (std::size_t m = 0; m < members; ++m) {
    set_member(start, m, mode);
  }
  Numbers eigenvalue = Numbers::Zero();
  for (int iteration = 0; iteration < tightness_iterations; ++iteration) {
    const Numbers norm = sum_of_each(nodes, [&](std::size_t a) { return dot(mode[a], mode[a]); }).sqrt();
    const Numbers scale = small_mode * std::sqrt(static_cast<double>(nodes)) / norm;
    for (VectorOfEach<double>& of_node : mode) {
      for (auto& axis : of_node.of) {
        numbers(axis) *= scale;
      }
    }
    force.find(mode, resistance);
    const Numbers inertia =
        sum_of_each(nodes, [&](std::size_t a) -> Numbers { return numbers(bound[a].of) * dot(mode[a], mode[a]); });
    eigenvalue = sum_of_each(nodes, [&](std::size_t a) { return dot(mode[a], resistance[a]); }) / inertia;
    for (std::size_t a = 0; a < nodes; ++a) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        numbers(mode[a].of[axis]) = numbers(resistance[a].of[axis]) / numbers(bound[a].of);
      }
    }
  }
  return (tightness_margin * eigenvalue).min(1.0);
}

}  // namespace brainshift::solve
