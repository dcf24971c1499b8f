// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far two solutions lie apart: the displacement field of the second, by its own shape functions, at the nodes of
// the first. The clouds may differ.
//
//   compare_solutions FIRST/solution.vtu SECOND/solution.vtu
//
// Prints: largest, 95th percentile and mean of the difference, mm.
#include <cstdio>
#include <exception>

#include "solve/output/field_difference.hpp"
#include "solve/output/solution_file.hpp"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: compare_solutions FIRST.vtu SECOND.vtu\n");
    return 2;
  }
  try {
    const auto apart =
        brainshift::solve::field_difference(brainshift::read_solution(argv[1]), brainshift::read_solution(argv[2]));
    std::printf("largest %.4f  95%% %.4f  mean %.4f mm\n", apart.largest, apart.percentile_95, apart.mean);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "compare_solutions: %s\n", error.what());
    return 2;
  }
}
