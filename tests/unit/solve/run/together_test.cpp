// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/together.hpp"

#include <gtest/gtest.h>

#include "solve/device/backend.hpp"
#include "solve/device/device_fault.hpp"
#include "solve/run/coarse.hpp"
#include "solve/run/completed.hpp"
#include "solve/run/whole_body.hpp"
#include "tests/unit/segmentation/shapes.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::together_test {

/// A block under drained fluid and a moved face.
Model drained_block() {
  Model model = box_model(test::box_cells(7, model_side), 8);
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const double z = model.cloud.positions(a, 2);
    if (z < 1e-9 || z > model_side - 1e-9) {
      model.conditions.displacement.row(a) << 0, 0, z < 1e-9 ? 0 : -3;
    }
  }
  model.skull = test::box(Eigen::Vector3d::Constant(-2), Eigen::Vector3d::Constant(62));
  model.fluid = DrainedFluid{.gravity = {0, 9.8, 0}, .gravity_of_image = {0, 9.8, 0}, .level = 30, .density = 1007};
  return model;
}

std::vector<Constants> some_constants(const Model& model, std::size_t count) {
  std::vector<Constants> all;
  for (std::size_t m = 0; m < count; ++m) {
    const auto x = static_cast<double>(m);
    Constants& c = all.emplace_back(Constants{.materials = model.materials, .gravity = {}, .fluid = model.fluid});
    c.gravity.setZero();
    c.materials[1].poisson_ratio = 0.45 + 0.01 * x;
    c.fluid->level -= 5 * x;
  }
  return all;
}

SolveOptions quick() {
  SolveOptions options;
  options.shape.basis = Basis::linear;
  options.load_steps = 100;
  options.tolerance = 0.003;
  return options;
}

TEST(Together, TakesDoublePrecisionForThoseConstantsAloneThatWantIt) {
  const Model model = drained_block();
  std::vector<Constants> constants = some_constants(model, 3);
  constants[1].materials[1].poisson_ratio = 0.4995;
  SolveOptions options = quick();
  options.precision = Precision::single_precision;
  const auto coarse = coarse_displacements(model, options, constants, {});
  const auto whole = whole_displacements(model, options, constants, {});
  for (std::size_t m = 0; m < constants.size(); ++m) {
    const Model with = with_constants(model, constants[m]);
    const bool in_double = completed(options, with).precision == Precision::double_precision;
    EXPECT_EQ(in_double, m == 1);
    const auto alone = coarse_displacement(with, completed(options, with), {});
    ASSERT_TRUE(alone && coarse[m] && whole[m]);
    EXPECT_LT((*coarse[m] - *alone).cwiseAbs().maxCoeff(), in_double ? 1e-7 : 1e-5);
    const Points solved = solve_whole_body(with, options, {}).solution.displacement;
    EXPECT_LT((*whole[m] - solved).cwiseAbs().maxCoeff(), in_double ? 1e-6 : 1e-4);
  }
}

TEST(Together, CoarseDisplacementsAreThoseOfEachAlone) {
  const Model model = drained_block();
  const std::vector<Constants> constants = some_constants(model, 2);
  const auto together = coarse_displacements(model, quick(), constants, {});
  for (std::size_t m = 0; m < constants.size(); ++m) {
    const auto alone = coarse_displacement(with_constants(model, constants[m]), quick(), {});
    ASSERT_TRUE(alone && together[m]);
    EXPECT_LT((*together[m] - *alone).cwiseAbs().maxCoeff(), 1e-7);
  }
  EXPECT_GT((*together[0] - *together[1]).cwiseAbs().maxCoeff(), 0.01);
}

TEST(Together, WholeDisplacementsAreThoseOfEachAlone) {
  const Model model = drained_block();
  SolveOptions options = quick();
  options.start = Start::coarse;
  const std::vector<Constants> constants = some_constants(model, 2);
  const auto together = whole_displacements(model, options, constants, {});
  for (std::size_t m = 0; m < constants.size(); ++m) {
    const SolveResult alone = solve_whole_body(with_constants(model, constants[m]), options, {});
    ASSERT_TRUE(alone.failure.empty() && together[m]) << alone.failure;
    EXPECT_LT((*together[m] - alone.solution.displacement).cwiseAbs().maxCoeff(), 1e-7);
  }
}

TEST(Together, GoesToTheDeviceThatIsAskedForOrSaysWhyNot) {
  const Model model = drained_block();
  const std::vector<Constants> constants = some_constants(model, 2);
  const auto expected = coarse_displacements(model, quick(), constants, {});
  SolveOptions options = quick();
  for (const Device device : {Device::automatic, Device::cuda}) {
    options.device = device;
    if (device == Device::cuda && device::gpu() == nullptr) {
      EXPECT_THROW(coarse_displacements(model, options, constants, {}), device::NotOnDevice);
      EXPECT_THROW(whole_displacements(model, options, constants, {}), device::NotOnDevice);
      continue;
    }
    const auto together = coarse_displacements(model, options, constants, {});
    for (std::size_t m = 0; m < constants.size(); ++m) {
      ASSERT_TRUE(together[m]);
      EXPECT_LT((*together[m] - *expected[m]).cwiseAbs().maxCoeff(), 1e-4);
    }
  }
}

/// Tissues that swell are no members of an ensemble, but have an answer.
TEST(Together, SolvesAloneWhatDoesNotGoTogether) {
  Model model = drained_block();
  model.materials[1].swelling = 0.02;
  const std::vector<Constants> constants = some_constants(model, 1);
  const auto together = coarse_displacements(model, quick(), constants, {});
  const auto alone = coarse_displacement(with_constants(model, constants[0]), quick(), {});
  ASSERT_TRUE(alone && together[0]);
  EXPECT_EQ(*together[0], *alone);
}

}  // namespace brainshift::solve::together_test
