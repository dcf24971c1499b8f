// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/solve_each.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "solve/solve.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/cut_bodies.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::solve_each_test {

using testing::HasSubstr;

/// A cube of two layers, pressed by a tenth.
Model layered() {
  Model model = uniaxial(0.9, 5);
  test::label_cells(model.cells, [](const Eigen::RowVector3d& low) { return low[2] < model_side / 2 - 1e-6 ? 1 : 2; });
  model.materials[2] = model.materials[1];
  return model;
}

std::vector<Constants> some_constants(const Model& model) {
  std::vector<Constants> all(3, Constants{.materials = model.materials});
  all[1].materials[2].youngs_modulus *= 3;
  all[2].materials[1].poisson_ratio = 0.4;
  return all;
}

void expect_each_as_alone(const Model& model, const std::vector<Constants>& constants) {
  const auto each = solve_each(model, {}, constants);
  ASSERT_EQ(each.size(), constants.size());
  for (std::size_t m = 0; m < constants.size(); ++m) {
    Model with = model;
    with.materials = constants[m].materials;
    const SolveResult alone = solve(with, {});
    ASSERT_TRUE(each[m] && alone.failure.empty()) << alone.failure;
    EXPECT_LT((*each[m] - alone.solution.displacement).cwiseAbs().maxCoeff(), 1e-7);
  }
  EXPECT_GT((*each[0] - *each[1]).cwiseAbs().maxCoeff(), 0.1);
}

TEST(SolveEach, IsSolveWithEachOfTheConstants) {
  expect_each_as_alone(layered(), some_constants(layered()));
}

/// Where a tissue is ten times as stiff as another or more, the body is another one; constants of one body do not stand
/// side by side.
TEST(SolveEach, TakesContrastsThatMakeOtherBodies) {
  const Model model = layered();
  std::vector<Constants> constants(5, Constants{.materials = model.materials});
  for (const auto& [m, factor] : {std::pair(0U, 100), {1U, 1}, {2U, 10}, {3U, 12}}) {
    constants[m].materials[2].youngs_modulus *= factor;
  }
  constants[4].materials[1].youngs_modulus *= 10;
  expect_each_as_alone(model, constants);
}

TEST(SolveEach, KnowsPlaneStress) {
  Model model = test::strip(1.1, Plane::stress);
  std::vector<Constants> constants(2, Constants{.materials = model.materials});
  constants[1].materials[1].poisson_ratio = 0.2;
  expect_each_as_alone(model, constants);
}

/// Members of an ensemble do not swell.
TEST(SolveEach, TakesConstantsThatDoNotGoTogether) {
  std::vector<Constants> constants = some_constants(layered());
  constants[1].materials[1].swelling = 0.05;
  expect_each_as_alone(layered(), constants);
}

TEST(SolveEach, RefusesConstantsThatLackAMaterial) {
  const Model model = layered();
  std::vector<Constants> constants = some_constants(model);
  constants[1].materials.erase(2);
  EXPECT_THAT(test::refusal([&] { solve_each(model, {}, constants); }),
              HasSubstr("constants 1 have no material for label 2"));
  constants = some_constants(model);
  constants[2].materials[1].poisson_ratio = 0.7;
  EXPECT_THAT(test::refusal([&] { solve_each(model, {}, constants); }), HasSubstr("label 1 in constants 2"));
}

TEST(SolveEach, RefusesWhatItDoesNotGoWith) {
  SolveOptions in_time;
  in_time.dynamics = Dynamics::transient;
  const Model model = layered();
  EXPECT_THAT(test::refusal([&] { solve_each(model, in_time, some_constants(model)); }), HasSubstr("motion in time"));
}

}  // namespace brainshift::solve::solve_each_test
