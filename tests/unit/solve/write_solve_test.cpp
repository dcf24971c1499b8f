// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <set>

#include "solve/output/solution_file.hpp"
#include "solve/solve.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::write_solve_test {

namespace fs = std::filesystem;
using test::ScratchFolder;

/// Four nodes that move, as a solution without any part has them.
SolveResult plain() {
  const NodeCloud cloud = test::irregular_box(2, 10);
  SolveResult result;
  result.solution = {.positions = cloud.positions,
                     .displacement = 0.1 * cloud.positions,
                     .reaction_force = Points::Zero(8, 3),
                     .spacing = cloud.spacing,
                     .shape = {.basis = Basis::linear}};
  result.history = {{.step = 20, .time = 0.5}, {.step = 40, .time = 1}};
  return result;
}

/// A face of one triangle, above and below.
CutSurface one_face() {
  CutSurface faces;
  faces.vertices = Points::Random(6, 3);
  faces.displacement = Points::Random(6, 3);
  faces.facets.resize(2, 3);
  faces.facets << 0, 1, 2, 3, 5, 4;
  faces.side = {1, 1, 1, -1, -1, -1};
  return faces;
}

std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    names.insert(fs::relative(entry.path(), folder).string());
  }
  return names;
}

TEST(WriteSolve, OfASolutionAloneIsTheSolutionAndItsHistory) {
  const ScratchFolder folder;
  const SolveResult result = plain();
  write_solve(folder.path(), result);
  EXPECT_EQ(files_in(folder.path()), (std::set<std::string>{"solution.vtu", "history.csv"}));
  EXPECT_EQ(read_solution(folder / "solution.vtu").displacement, result.solution.displacement);
}

TEST(WriteSolve, HasAFileForEachPartThatTheResultHas) {
  const ScratchFolder folder;
  SolveResult result = plain();
  result.stress_strain = {{.time = 1, .elongation = 0.1, .stress = 300}};
  result.faces = one_face();
  for (const int step : {20, 40}) {
    result.snapshots.push_back(
        {.step = step, .displacement = result.solution.displacement, .positions = result.solution.positions});
  }
  result.snapshots[1].faces = one_face();
  write_solve(folder.path(), result);
  EXPECT_EQ(files_in(folder.path()),
            (std::set<std::string>{"solution.vtu", "history.csv", "stress_strain.csv", "cut.vtp", "steps.pvd", "steps",
                                   "steps/000020.vtu", "steps/000040.vtu", "steps/000040_cut.vtp"}));
}

TEST(WriteSolve, NamesTheFileThatCannotBeWritten) {
  SolveResult result = plain();
  result.stress_strain = {{.time = 1, .elongation = 0.1, .stress = 300}};
  result.faces = one_face();
  result.snapshots.push_back({.step = 20, .displacement = Points(0, 3)});
  for (const char* file : {"solution.vtu", "history.csv", "stress_strain.csv", "cut.vtp", "steps", "steps.pvd"}) {
    const ScratchFolder folder;
    fs::create_directories(folder / file);
    if (fs::path(file) == "steps") {
      fs::remove(folder / file);
      folder.write(file, "not a folder");
    }
    try {
      write_solve(folder.path(), result);
      ADD_FAILURE() << file;
    } catch (const std::runtime_error& fault) {
      EXPECT_TRUE(std::string(fault.what()).starts_with((folder / file).string() + ": ")) << fault.what();
    }
  }
}

}  // namespace brainshift::solve::write_solve_test
