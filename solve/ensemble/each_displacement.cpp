// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble/each_displacement.hpp"

#include "solve/arrays/shared_work.hpp"

namespace brainshift::solve {

namespace {

BRAINSHIFT_CLONES
void add_row(const ShapeRow& row, const VectorOfEach<double>* parameters, VectorOfEach<double>& sum) {
  for (std::size_t k = 0; k < row.size(); ++k) {
    const VectorOfEach<double>& parameter = parameters[row.node[k]];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t m = 0; m < members; ++m) {
        sum.of[axis][m] += row.value[k] * parameter.of[axis][m];
      }
    }
  }
}

}  // namespace

EachVectors displacement_of_each(const ShapeRows& nodal_rows, const EachVectors& parameters) {
  EachVectors displacement(nodal_rows.size(), VectorOfEach<double>{});
  share_work(static_cast<std::int64_t>(nodal_rows.size()), nodes_a_part, [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    add_row(nodal_rows[a], parameters.data(), displacement[a]);
  });
  return displacement;
}

Numbers longest_difference_of_each(const EachVectors& a, const EachVectors& b) {
  Numbers squared = Numbers::Zero();
  for (std::size_t i = 0; i < a.size(); ++i) {
    const VectorOfEach<double> moved = difference(a[i], b[i]);
    squared = -lesser_of_each(-squared, -dot(moved, moved));
  }
  return squared.sqrt();
}

}  // namespace brainshift::solve
