// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/device/each/relax_together.hpp"

#include <algorithm>

#include "solve/device/each/device_ensemble.hpp"
#include "solve/device/each/relax_together_if_asked.hpp"
#include "solve/shape/too_few_nodes.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/device/backends.hpp"
#include "tests/unit/solve/material_cases.hpp"
#include "tests/unit/solve/pressed.hpp"

namespace brainshift::solve::device {

namespace relax_together_on_device_test {

class RelaxTogetherOnDevice : public OnDevice {
 protected:
  static std::vector<MemberResult> on_device(const Pressed& pressed, const std::vector<Member>& loads) {
    return device::relax_together(backend(), pressed.body(), loads, pressed.model.curve, pressed.options, {});
  }
};
INSTANTIATE_TEST_SUITE_P(Of, RelaxTogetherOnDevice, testing::Values(On::one_thread, On::gpu), name_of_device);

void expect_same(const MemberResult& result, const MemberResult& expected, double rounding) {
  EXPECT_EQ(result.end, expected.end);
  EXPECT_EQ(result.steps, expected.steps);
  ASSERT_EQ(result.parameters.size(), expected.parameters.size());
  EXPECT_LT(largest_difference(result.parameters, expected.parameters), rounding);
  if (expected.end == MemberResult::End::rest) {
    constexpr double of_rounding = 1e-13;  // mm
    EXPECT_NEAR(result.error_bound, expected.error_bound, 1e-3 * expected.error_bound + of_rounding);
  }
}

void expect_same(const std::vector<MemberResult>& results, const std::vector<MemberResult>& expected, double rounding) {
  ASSERT_EQ(results.size(), expected.size());
  for (std::size_t m = 0; m < results.size(); ++m) {
    SCOPED_TRACE("member " + std::to_string(m));
    ASSERT_EQ(expected[m].end, MemberResult::End::rest);
    expect_same(results[m], expected[m], rounding);
  }
}

TEST_P(RelaxTogetherOnDevice, BringsEachMemberToRestWhereAndWhenTheHostDoes) {
  const Pressed pressed(1e-6);
  std::vector<Member> loads = pressed.loads(5);
  const std::vector<MemberResult> expected = pressed.together(loads);
  const auto [first, last] = std::minmax_element(expected.begin(), expected.end(),
                                                 [](const auto& a, const auto& b) { return a.steps < b.steps; });
  ASSERT_NE(first->steps, last->steps) << "all end at once";
  ASSERT_GT(pressed.body().contact->measure(expected[0].parameters).touching, 10U);
  expect_same(on_device(pressed, loads), expected, 1e-9);
  for (Member& load : loads) {
    load.start = expected[0].parameters;
    for (double& u : load.start) {
      u *= 0.9;  // else nothing but rounding would be left to do
    }
  }
  expect_same(on_device(pressed, loads), pressed.together(loads), 1e-9);
}

TEST_P(RelaxTogetherOnDevice, TakesALawOfItsOwnKindForEachMember) {
  const Pressed pressed(1e-6);
  std::vector<Member> loads;
  for (const Material& material : library_laws) {
    loads.push_back({.laws = pressed.body().laws, .external = {}});
    loads.back().laws.elastic.front() = elastic_law(material);
  }
  ASSERT_GT(loads.size(), 3U);
  const std::vector<MemberResult> expected = pressed.together(loads), results = on_device(pressed, loads);
  int rest = 0;
  for (std::size_t m = 0; m < loads.size(); ++m) {
    SCOPED_TRACE("member " + std::to_string(m));
    expect_same(results[m], expected[m], 1e-8);
    rest += expected[m].end == MemberResult::End::rest ? 1 : 0;
  }
  EXPECT_GT(rest, 2);
}

TEST_P(RelaxTogetherOnDevice, KeepsTheDigitsOfSinglePrecisionAndTheBitsWhateverTheOthers) {
  const Pressed pressed(0.003);
  ASSERT_EQ(pressed.body().points.precision(), Precision::single_precision);
  const std::vector<Member> two = pressed.loads(2);
  std::vector<Member> many;
  for (int i = 0; i <= most_members; ++i) {
    many.push_back(two[static_cast<std::size_t>(i) % 2]);
  }
  const std::vector<MemberResult> expected = pressed.together(two), results = on_device(pressed, two),
                                  of_many = on_device(pressed, many);
  ASSERT_EQ(of_many.size(), many.size());
  for (std::size_t m = 0; m < two.size(); ++m) {
    ASSERT_EQ(results[m].end, MemberResult::End::rest);
    EXPECT_LT(largest_difference(results[m].parameters, expected[m].parameters), 1e-4);
  }
  for (std::size_t m = 0; m < many.size(); ++m) {
    EXPECT_EQ(of_many[m].parameters, results[m % 2].parameters) << m;
    EXPECT_EQ(of_many[m].steps, results[m % 2].steps) << m;
  }
}

TEST_P(RelaxTogetherOnDevice, LetsConditionsWithNoiseGiveWayAndPrescribesToEachItsOwn) {
  Pressed pressed(1e-6);
  pressed.make_noisy();
  std::vector<Member> loads = pressed.loads(3);
  loads[1].prescribed = 0.5 * pressed.prepared.parts->cloud.conditions.displacement;
  const std::vector<MemberResult> expected = pressed.together(loads);
  ASSERT_GT(largest_difference(expected[0].parameters, expected[1].parameters), 0.1);
  expect_same(on_device(pressed, loads), expected, 1e-8);
}

TEST_P(RelaxTogetherOnDevice, LeavesAMemberThatFailsToBeSolvedAloneAndTheOthersAsTheyAre) {
  const Pressed pressed(0.003);
  std::vector<Member> loads = pressed.loads(3);
  const std::vector<MemberResult> before = on_device(pressed, loads);
  NodalVectors huge(4 * pressed.model.cloud.size(), 0.0);
  for (std::size_t a = 0; a < huge.size() / 4; ++a) {
    at(huge, a) << 3e11 * (a % 2 == 0 ? 1 : -1), 0, 0, 0;  // pulls neighbours through each other
  }
  loads[1].external = ExternalForce(std::move(huge));
  const std::vector<MemberResult> after = on_device(pressed, loads);
  EXPECT_EQ(after[1].end, MemberResult::End::left);
  EXPECT_TRUE(after[1].parameters.empty());
  for (const std::size_t m : {0U, 2U}) {
    EXPECT_EQ(after[m].end, MemberResult::End::rest);
    EXPECT_EQ(after[m].parameters, before[m].parameters);
    EXPECT_EQ(after[m].steps, before[m].steps);
  }
}

TEST_P(RelaxTogetherOnDevice, LeavesAMemberWhoseStartTurnsPointsInsideOut) {
  const Pressed pressed(0.003);
  const std::vector<Member> loads = pressed.loads_of_which_the_last_starts_inside_out(2);
  EXPECT_EQ(on_device(pressed, loads)[1].end, MemberResult::End::left);
}

TEST_P(RelaxTogetherOnDevice, BringsTheLoadOfEachAtAPaceOfItsOwn) {
  const Pressed pressed(1e-6);
  std::vector<Member> loads = pressed.loads(2);
  Material stiff_in_volume = pressed.model.materials.at(1);
  stiff_in_volume.poisson_ratio = 0.496;
  loads[1].laws.elastic.front() = elastic_law(stiff_in_volume);
  ASSERT_EQ(pressed.together(loads)[1].end, MemberResult::End::left) << "the paces are the same";
  const std::vector<MemberResult> results = on_device(pressed, loads);
  for (std::size_t m = 0; m < loads.size(); ++m) {
    const SteppingResult expected = pressed.alone(loads[m], {});
    EXPECT_EQ(results[m].end, MemberResult::End::rest);
    EXPECT_EQ(results[m].steps, expected.steps);
    EXPECT_LT(largest_difference(results[m].parameters, expected.parameters), 1e-9);
  }
}

TEST_P(RelaxTogetherOnDevice, StopsWhereTheStepsAreUsedUp) {
  Pressed pressed(1e-6);
  pressed.options.max_steps = 47;
  const std::vector<MemberResult> results = on_device(pressed, pressed.loads(2));
  for (const MemberResult& result : results) {
    EXPECT_EQ(result.end, MemberResult::End::not_converged);
    EXPECT_EQ(result.steps, 47);
  }
}

TEST_P(RelaxTogetherOnDevice, SaysWhichConditionsRepeatEachOther) {
  Pressed pressed(1e-3);
  pressed.repeat_conditions();
  EXPECT_THROW(on_device(pressed, pressed.loads(2)), TooFewNodes);
}

TEST(RelaxTogetherIfAsked, LeavesToTheCpuWhatIsNotAskedForOrCannotBe) {
  const Pressed pressed(0.003);
  SolveOptions options = pressed.options;
  std::vector<Member> loads = pressed.loads(2);
  const auto ask = [&] { return relax_together_if_asked(pressed.body(), loads, pressed.model.curve, options, {}); };
  EXPECT_FALSE(ask());
  loads[1].laws.elastic.front() = elastic_law(fung(1000, 0.5, 0.49));
  options.device = Device::automatic;
  EXPECT_FALSE(ask());
  options.device = Device::cuda;
  const std::string refused = test::refusal(ask);
  EXPECT_TRUE(refused.starts_with("device cuda: ")) << refused;
  EXPECT_TRUE(refused.ends_with("; take cpu, or auto")) << refused;
  EXPECT_EQ(refused.find("a law of its own") != std::string::npos, gpu() != nullptr) << refused;
}

}  // namespace relax_together_on_device_test

}  // namespace brainshift::solve::device
