// SPDX-License-Identifier: GPL-3.0-or-later
//
// A node cloud and background cells of one's own, and a load on them: a cube that is pressed by a tenth of its height.
// Writes out/solution.vtu and out/history.csv, which ParaView opens.
#include <filesystem>
#include <iostream>

#include "block.hpp"
#include "solve/solve.hpp"

int main() {
  using namespace brainshift;
  solve::Model model = examples::pressed_cube();
  model.materials = {{1, {.youngs_modulus = 3000, .poisson_ratio = 0.49}}};
  const solve::SolveResult result = solve::solve(model, {});
  std::filesystem::create_directories("out");
  solve::write_solve("out", result);
  std::cout << result.measures.nodes << " nodes, " << result.measures.steps << " steps, reaction "
            << result.history.back().reaction.z() << " N\n";
  return result.measures.converged ? 0 : 3;
}
