// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far two solutions lie apart: the displacement field of the second, by its own shape functions, at the nodes of
// the first. The clouds may differ.
//
//   compare_solutions FIRST/solution.vtu SECOND/solution.vtu
//
// Prints: largest, 95th percentile and mean of the difference, mm.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <vector>

#include "solve/shape/shape_functions.hpp"
#include "solve/solution.hpp"

namespace {

using namespace brainshift;

std::vector<double> differences(const Solution& first, const Solution& second) {
  const solve::ShapeFunctions shape(second.positions, second.spacing, second.shape);
  const Points parameters = solve::parameters_from_displacement(shape, second.positions, second.displacement);
  const Points moved = shape.interpolate(first.positions, parameters);
  std::vector<double> result;
  for (Eigen::Index a = 0; a < moved.rows(); ++a) {
    result.push_back((moved.row(a) - first.displacement.row(a)).norm());
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: compare_solutions FIRST.vtu SECOND.vtu\n");
    return 2;
  }
  try {
    const std::vector<double> sorted = differences(read_solution(argv[1]), read_solution(argv[2]));
    double sum = 0;
    for (const double d : sorted) {
      sum += d;
    }
    std::printf("largest %.4f  95%% %.4f  mean %.4f mm\n", sorted.back(), sorted[sorted.size() * 95 / 100],
                sum / static_cast<double>(sorted.size()));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "compare_solutions: %s\n", error.what());
    return 2;
  }
}
