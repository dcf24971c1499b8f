// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/output/steps.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "solve/solve.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/cut_bodies.hpp"
#include "tests/unit/solve/models.hpp"
#include "tests/unit/solve/pulled_square.hpp"

namespace brainshift::solve::steps_test {

namespace fs = std::filesystem;

TEST(CutSurface, IsAPartOfEachStepOnceThereIsACut) {
  const test::ScratchFolder folder;
  Model model = pulled_square();
  model.cuts[0].time = {0.4, 0.8};
  SolveOptions options = test::plane_options();
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

TEST(Steps, OfATransientRunStandAtTheirTime) {
  const test::ScratchFolder folder;
  SolveResult result;
  result.measures.critical_step = 0.001;
  for (const int step : {50, 100}) {
    result.snapshots.push_back({.step = step, .time = 0.0009 * step, .positions = Points::Zero(1, 3)});
    result.snapshots.back().displacement = Points::Zero(1, 3);
  }
  write_steps(folder.path(), result);
  std::ostringstream text;
  text << std::ifstream(folder / "steps.pvd").rdbuf();
  EXPECT_NE(text.str().find("timestep=\"0.045\" file=\"steps/000050.vtu\""), std::string::npos);
  EXPECT_NE(text.str().find("timestep=\"0.09\" file=\"steps/000100.vtu\""), std::string::npos);
}

}  // namespace brainshift::solve::steps_test
