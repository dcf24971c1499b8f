// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/device/relax_on_device.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "solve/device/relax_if_asked.hpp"
#include "solve/run/completed.hpp"
#include "solve/shape/nodal_displacement.hpp"
#include "solve/shape/too_few_nodes.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/device/backends.hpp"
#include "tests/unit/solve/pressed.hpp"
#include "tests/unit/solve/turned_cube.hpp"

namespace brainshift::solve::device {

namespace {

class RelaxOnDevice : public OnDevice {
 protected:
  static SteppingResult on_device(const Pressed& pressed, const NodalVectors& start, bool cautious = false) {
    Body body = pressed.body();
    body.external = external_force(pressed.model, *pressed.prepared.parts, Dynamics::relaxation);
    return device::relax(backend(), body, {.curve = pressed.model.curve, .start = start}, pressed.options, cautious, {})
        .result;
  }
  static SteppingResult on_host(const Pressed& pressed, const NodalVectors& start) {
    return pressed.alone({.laws = pressed.body().laws,
                          .external = external_force(pressed.model, *pressed.prepared.parts, Dynamics::relaxation)},
                         start);
  }
};
INSTANTIATE_TEST_SUITE_P(Of, RelaxOnDevice, testing::Values(On::one_thread, On::gpu), name_of_device);

void expect_same(const SteppingResult& result, const SteppingResult& expected, double rounding) {
  ASSERT_EQ(result.failure, "");
  EXPECT_EQ(result.steps, expected.steps);
  EXPECT_LT(largest_difference(result.parameters, expected.parameters), rounding);
  EXPECT_NEAR(result.error_bound, expected.error_bound, 1e-3 * expected.error_bound);
  EXPECT_LT((result.reactions - expected.reactions).cwiseAbs().maxCoeff(),
            1e-4 * expected.reactions.cwiseAbs().maxCoeff());
  ASSERT_EQ(result.history.size(), expected.history.size());
  double largest = 0;
  for (const HistoryRow& row : expected.history) {
    largest = std::max(largest, row.external_work);
  }
  for (std::size_t i = 0; i < result.history.size(); ++i) {
    const HistoryRow &row = result.history[i], &other = expected.history[i];
    EXPECT_EQ(row.step, other.step);
    EXPECT_EQ(row.time, other.time);
    EXPECT_NEAR(row.external_work, other.external_work, 1e-4 * largest) << "step " << row.step;
    EXPECT_NEAR(row.strain_energy, other.strain_energy, 1e-4 * largest) << "step " << row.step;
    EXPECT_NEAR(row.kinetic_energy, other.kinetic_energy, 1e-4 * largest) << "step " << row.step;
    EXPECT_NEAR(row.dissipated_energy, other.dissipated_energy, 1e-4 * largest) << "step " << row.step;
    EXPECT_NEAR(row.reaction.norm(), other.reaction.norm(), 1e-3 * expected.history.back().reaction.norm());
  }
}

}  // namespace

TEST_P(RelaxOnDevice, ComesToRestWhereAndWhenTheHostDoes) {
  const Pressed pressed(1e-6);
  const SteppingResult expected = on_host(pressed, {});
  ASSERT_GT(expected.body.contact->measure(expected.parameters).touching, 10U);
  expect_same(on_device(pressed, {}), expected, 1e-9);
  NodalVectors near = expected.parameters;
  for (double& u : near) {
    u *= 0.9;  // else nothing but rounding would be left to do
  }
  expect_same(on_device(pressed, near), on_host(pressed, near), 1e-9);
}

TEST_P(RelaxOnDevice, KeepsTheDigitsOfSinglePrecision) {
  const Pressed pressed(0.003);
  ASSERT_EQ(pressed.body().points.precision(), Precision::single_precision);
  const SteppingResult result = on_device(pressed, {});
  EXPECT_LT(largest_difference(result.parameters, on_host(pressed, {}).parameters), 1e-4);
  EXPECT_EQ(on_device(pressed, {}).parameters, result.parameters) << "not the same bits";
}

TEST_P(RelaxOnDevice, LetsConditionsWithNoiseGiveWayAsTheHostDoes) {
  Pressed pressed(1e-6);
  pressed.make_noisy();
  const SteppingResult expected = on_host(pressed, {});
  EXPECT_GT(expected.body.essential.largest_error(1, expected.parameters), 0.01) << "they do not give way";
  expect_same(on_device(pressed, {}), expected, 1e-8);
}

TEST_P(RelaxOnDevice, SaysWhichConditionsRepeatEachOther) {
  Pressed pressed(1e-3);
  pressed.repeat_conditions();
  EXPECT_THROW(on_device(pressed, {}), TooFewNodes);
}

TEST_P(RelaxOnDevice, EndsWithTheSmallestStepsToo) {
  Pressed pressed(1e-5);
  pressed.prepared.body.contact.reset();  // how nodes in contact share a push depends on the masses
  const SteppingResult result = on_device(pressed, {}, true);
  ASSERT_EQ(result.failure, "");
  EXPECT_GT(result.steps, on_host(pressed, {}).steps);
  EXPECT_LT(largest_difference(result.parameters, on_host(pressed, {}).parameters), 2e-5);
}

TEST_P(RelaxOnDevice, SaysWhereABodyBecomesUnstableAndKeepsTheLastGoodState) {
  Pressed pressed(0.003);
  NodalVectors huge(4 * pressed.model.cloud.size(), 0.0);
  for (std::size_t a = 0; a < huge.size() / 4; ++a) {
    at(huge, a) << 3e11 * (a % 2 == 0 ? 1 : -1), 0, 0, 0;  // pulls neighbours through each other
  }
  pressed.prepared.body.external = ExternalForce(std::move(huge));
  Body body = pressed.body();
  const SteppingResult result =
      device::relax(backend(), body, {.curve = pressed.model.curve}, pressed.options, false, {}).result;
  EXPECT_TRUE(result.unstable);
  EXPECT_NE(result.failure.find("unstable at step"), std::string::npos) << result.failure;
  ASSERT_TRUE(result.fault);
  EXPECT_TRUE(std::isfinite(largest_component(result.parameters)));
}

TEST_P(RelaxOnDevice, StopsWhereTheStepsAreUsedUp) {
  Pressed pressed(1e-6);
  pressed.options.max_steps = 47;
  const SteppingResult result = on_device(pressed, {});
  EXPECT_EQ(result.steps, 47);
  EXPECT_NE(result.failure.find("not converged after 47 steps"), std::string::npos) << result.failure;
}

TEST_P(RelaxOnDevice, LeavesASlowBodyToTheHostWhichGoesOnFromThere) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.1, Eigen::Vector3d(1, 2, 0).normalized()).toRotationMatrix();
  const Model model = turned_by_a_patch(turn);
  const SolveOptions options = completed({}, model);
  SolveMeasures measures;
  Body body = prepare(model, options, {}, measures, {}).body;
  const Course course{.curve = model.curve};
  Relaxed left = device::relax(backend(), body, course, options, false, {});
  ASSERT_TRUE(left.slow);
  const int steps = left.result.steps;
  const SteppingResult result = go_on(std::move(left.result), course, options, {});
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.steps, steps);
  EXPECT_LT(result.steps, 3000);  // 3,720 without its rigid modes, see Turned
  const Points moved = nodal_displacement(result.body.nodal_rows, result.parameters, result.body.original);
  EXPECT_LE((moved - turn_of(result.body.positions, turn)).rowwise().norm().maxCoeff(), 2 * result.error_bound);
  EXPECT_EQ(result.history.back().step, result.steps);
  EXPECT_TRUE(std::is_sorted(result.history.begin(), result.history.end(),
                             [](const HistoryRow& a, const HistoryRow& b) { return a.step < b.step; }));
}

TEST(RelaxIfAsked, LeavesToTheCpuWhatIsNotAskedForOrCannotBe) {
  const Pressed pressed(0.003);
  Body body = pressed.body();
  SolveOptions options = pressed.options;
  EXPECT_FALSE(relax_if_asked(body, {}, options, false, {}));
  body.laws.swelling = {0.1};
  options.device = Device::automatic;
  EXPECT_FALSE(relax_if_asked(body, {}, options, false, {}));
  options.device = Device::cuda;
  const std::string refused = test::refusal([&] { relax_if_asked(body, {}, options, false, {}); });
  EXPECT_TRUE(refused.starts_with("device cuda: ")) << refused;
  EXPECT_TRUE(refused.ends_with("; take cpu, or auto")) << refused;
  EXPECT_EQ(refused.find("swells") != std::string::npos, gpu() != nullptr) << refused;
}

}  // namespace brainshift::solve::device
