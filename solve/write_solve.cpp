// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/output/cut_surface.hpp"
#include "solve/output/history.hpp"
#include "solve/output/solution_file.hpp"
#include "solve/output/steps.hpp"
#include "solve/output/stress_strain.hpp"
#include "solve/solve.hpp"

namespace brainshift::solve {

void write_solve(const std::filesystem::path& folder, const SolveResult& result) {
  write_solution(folder / "solution.vtu", result.solution);
  write_history(folder / "history.csv", result.history);
  if (!result.stress_strain.empty()) {
    write_stress_strain(folder / "stress_strain.csv", result.stress_strain);
  }
  if (result.faces.vertices.rows() > 0) {
    write_cut_surface(folder / "cut.vtp", result.faces);
  }
  if (!result.snapshots.empty()) {
    write_steps(folder, result);
  }
}

}  // namespace brainshift::solve
