// SPDX-License-Identifier: GPL-3.0-or-later
//
// The brain, the load and the samples of the finite-element reference for the program: makes cloud and cells with the
// reference's displacements prescribed, and evaluates a solution at the reference's samples.
//
//   brain_load uniform|refined OUT NODES
//   brain_load at SOLUTION.vtu OUT.csv
#include <cstdio>
#include <exception>
#include <fstream>
#include <string>
#include <vector>

#include "solve/output/solution_file.hpp"
#include "tests/verification/loaded_brain.hpp"
#include "tests/verification/reference.hpp"

namespace {

using namespace brainshift;

void make_cloud(const std::vector<std::string>& words) {
  const solve::Model brain =
      verification::loaded_brain(std::stoul(words[2]), CellKind::hexahedron, words[0] == "refined");
  solve::write_nodes(words[1] + "/nodes.vtu", brain.cloud, brain.conditions);
  write_background_cells(words[1] + "/cells.vtu", brain.cells);
}

void evaluate(const std::vector<std::string>& words) {
  const Points places = verification::read_reference("brain", "").positions;
  const Points found = verification::displacement_at(read_solution(words[1]), places);
  std::ofstream csv(words[2]);
  csv << "ux,uy,uz\n" << found.format(Eigen::IOFormat(8, Eigen::DontAlignCols, ",")) << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  const bool cloud = words.size() == 3 && (words[0] == "uniform" || words[0] == "refined");
  if (!cloud && !(words.size() == 3 && words[0] == "at")) {
    std::fprintf(stderr, "usage: brain_load uniform|refined OUT NODES | at SOLUTION.vtu OUT.csv\n");
    return 2;
  }
  try {
    cloud ? make_cloud(words) : evaluate(words);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "brain_load: %s\n", error.what());
    return 1;
  }
  return 0;
}
