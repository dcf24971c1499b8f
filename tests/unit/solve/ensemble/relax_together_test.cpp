// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble/relax_together.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include "tests/unit/solve/pressed.hpp"

namespace brainshift::solve::relax_together_test {

void expect_as_alone(const Pressed& pressed, std::vector<Member> loads, const NodalVectors& start, double rounding) {
  for (Member& load : loads) {
    load.start = start;
  }
  const std::vector<MemberResult> together = pressed.together(loads);
  ASSERT_EQ(together.size(), loads.size());
  std::vector<int> steps;
  for (std::size_t m = 0; m < loads.size(); ++m) {
    const SteppingResult expected = pressed.alone(loads[m], start);
    ASSERT_TRUE(expected.failure.empty()) << expected.failure;
    ASSERT_EQ(together[m].end, MemberResult::End::rest);
    EXPECT_EQ(together[m].steps, expected.steps) << "member " << m;
    EXPECT_NEAR(together[m].error_bound, expected.error_bound, 1e-3 * expected.error_bound);
    EXPECT_LT(largest_difference(together[m].parameters, expected.parameters), rounding) << "member " << m;
    steps.push_back(expected.steps);
  }
  EXPECT_NE(*std::min_element(steps.begin(), steps.end()), *std::max_element(steps.begin(), steps.end()));
}

TEST(RelaxTogether, BringsEachMemberToRestWhereAndWhenItComesToRestAlone) {
  const Pressed pressed(1e-6);
  const std::vector<Member> loads = pressed.loads(5);
  expect_as_alone(pressed, loads, {}, 1e-9);
  SteppingResult near = pressed.alone(loads[0], {});
  EXPECT_GT(near.body.contact->measure(near.parameters).touching, 10U);
  for (double& u : near.parameters) {
    u *= 0.9;  // else nothing but rounding would be left to do
  }
  expect_as_alone(pressed, loads, near.parameters, 1e-9);
}

TEST(RelaxTogether, KeepsTheDigitsOfSinglePrecision) {
  const Pressed pressed(0.003);
  ASSERT_EQ(pressed.body().points.precision(), Precision::single_precision);
  const std::vector<Member> loads = pressed.loads(2);
  const std::vector<MemberResult> together = pressed.together(loads);
  for (std::size_t m = 0; m < loads.size(); ++m) {
    ASSERT_EQ(together[m].end, MemberResult::End::rest);
    EXPECT_LT(largest_difference(together[m].parameters, pressed.alone(loads[m], {}).parameters), 1e-4);
  }
}

TEST(RelaxTogether, LeavesAMemberThatFailsToBeSolvedAloneAndTheOthersAsTheyAre) {
  const Pressed pressed(0.003);
  std::vector<Member> loads = pressed.loads(3);
  const std::vector<MemberResult> before = pressed.together(loads);
  NodalVectors huge(4 * pressed.model.cloud.size(), 0.0);
  for (std::size_t a = 0; a < huge.size() / 4; ++a) {
    at(huge, a) << 3e11 * (a % 2 == 0 ? 1 : -1), 0, 0, 0;  // pulls neighbours through each other
  }
  loads[1].external = ExternalForce(std::move(huge));
  const std::vector<MemberResult> after = pressed.together(loads);
  EXPECT_EQ(after[1].end, MemberResult::End::left);
  for (const std::size_t m : {0U, 2U}) {
    EXPECT_EQ(after[m].end, MemberResult::End::rest);
    EXPECT_EQ(after[m].parameters, before[m].parameters);
  }
}

TEST(RelaxTogether, LeavesAMemberWhoseStartTurnsPointsInsideOut) {
  const Pressed pressed(0.003);
  EXPECT_EQ(pressed.together(pressed.loads_of_which_the_last_starts_inside_out(2))[1].end, MemberResult::End::left);
}

TEST(RelaxTogether, IsTheSameBitForBitForAnyNumberOfThreads) {
  const Pressed pressed(0.003);
  const std::vector<Member> loads = pressed.loads(2);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const std::vector<MemberResult> one = pressed.together(loads);
  omp_set_num_threads(3);
  const std::vector<MemberResult> three = pressed.together(loads);
  omp_set_num_threads(threads);
  for (std::size_t m = 0; m < loads.size(); ++m) {
    EXPECT_EQ(one[m].parameters, three[m].parameters);
    EXPECT_EQ(one[m].steps, three[m].steps);
  }
}

TEST(RelaxTogether, SaysWhatItDoesNotGoWith) {
  const Pressed pressed(0.003);
  std::vector<Member> loads = pressed.loads(2);
  EXPECT_TRUE(may_go_together(pressed.body(), loads, pressed.options));
  SolveOptions simplified = pressed.options;
  simplified.imposition = Imposition::simplified;
  EXPECT_FALSE(may_go_together(pressed.body(), loads, simplified));
  loads.back().laws.swelling = {0.1};
  EXPECT_FALSE(may_go_together(pressed.body(), loads, pressed.options));
}

}  // namespace brainshift::solve::relax_together_test
