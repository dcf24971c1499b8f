// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/output/steps.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "solve/solve.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::steps_test {

constexpr double side = 60;
namespace fs = std::filesystem;

/// A square in plane strain that is pulled open across a cut from its left side to x = 30.
Model square() {
  Model model;
  model.cloud = test::irregular_rectangle(21, 21, side, side);
  model.conditions = test::all_free(model.cloud);
  model.cells = test::rectangle_cells(20, 20, side, side);
  model.materials[1] = {3000, 0.45, 1000};
  model.plane = Plane::strain;
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const double y = model.cloud.positions(a, 1);
    if (y < 1e-9 || y > side - 1e-9) {
      model.conditions.displacement.row(a) << 0, y > 1 ? 6 : 0, std::nan("");
    }
  }
  Cut cut;
  cut.name = "path";
  cut.vertices.resize(2, 3);
  cut.vertices << -5, 30, 0, 30, 30, 0;
  model.cuts = {cut};
  return model;
}

SolveOptions planar_options() {
  SolveOptions options;
  options.points_per_cell = 4;
  return options;
}

TEST(CutSurface, IsAPartOfEachStepOnceThereIsACut) {
  const test::ScratchFolder folder;
  Model model = square();
  model.cuts[0].time = {0.4, 0.8};
  SolveOptions options = planar_options();
  options.snapshot_every = 100;
  const SolveResult result = solve(model, options);
  write_steps(folder.path(), result);
  EXPECT_FALSE(fs::exists(folder / "steps/000100_cut.vtp"));
  EXPECT_TRUE(fs::exists(folder / "steps/000300_cut.vtp"));
  EXPECT_TRUE(fs::exists(folder / "steps/000400.vtu"));
  std::ostringstream text;
  text << std::ifstream(folder / "steps.pvd").rdbuf();
  EXPECT_NE(text.str().find("timestep=\"400\" part=\"1\" file=\"steps/000400_cut.vtp\""), std::string::npos);
}

}  // namespace brainshift::solve::steps_test
