// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/damping_turns.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace brainshift::solve::damping_turns_test {

constexpr double lowest = 0.0025;
constexpr int begin = DampingTurns::if_far;

DampingTurns begun() {
  DampingTurns turns;
  turns.begin_if_due(begin, [] { return true; });
  return turns;
}

/// How far a mode of this eigenvalue is off after so many steps, over what it was off by at first; and one step before.
std::pair<double, double> left_of_mode(double eigenvalue, int steps, const DampingTurns& turns) {
  double now = 1, before = 1;
  for (int n = 0; n < steps; ++n) {
    const double beta = critical_beta(turns.eigenvalue(lowest, n / settled_window * settled_window));
    const double next = now + beta * (now - before) - relaxation_alpha * eigenvalue * now;
    before = std::exchange(now, next);
  }
  return {now, before};
}

/// Steps until all modes from this eigenvalue to 1 stay within a hundredth.
int steps_of_modes(double slowest, const DampingTurns& turns) {
  int last = 0;
  for (double eigenvalue = slowest; eigenvalue < 1; eigenvalue *= 1.1) {
    for (int n = 400; n > last; --n) {
      last = std::abs(left_of_mode(eigenvalue, n, turns).first) > 0.01 ? n : last;
    }
  }
  return last;
}

TEST(DampingTurns, HoldTheEigenvalueUntilTheyBegin) {
  const DampingTurns turns;
  for (const int steps : {0, begin, 1000}) {
    EXPECT_EQ(turns.eigenvalue(lowest, steps), lowest);
    EXPECT_EQ(turns.slowest(lowest, steps), 0);
  }
}

TEST(DampingTurns, BeginEarlyWhereMuchIsLeftAndElseLate) {
  DampingTurns turns;
  turns.begin_if_due(begin, [] { return false; });
  EXPECT_FALSE(turns.are_on(begin));
  turns.begin_if_due(DampingTurns::at_the_latest, [] { return false; });
  EXPECT_LT(turns.eigenvalue(lowest, DampingTurns::at_the_latest), lowest);
  DampingTurns early = begun();
  early.begin_if_due(DampingTurns::at_the_latest, [] { return true; });
  EXPECT_EQ(early.eigenvalue(lowest, begin + DampingTurns::slow_steps),
            begun().eigenvalue(lowest, begin + DampingTurns::slow_steps))
      << "begun anew";
}

TEST(DampingTurns, EndAfterTheirRounds) {
  const DampingTurns turns = begun();
  constexpr int of_a_round = DampingTurns::slow_steps + DampingTurns::quick_steps;
  constexpr int end = begin + DampingTurns::rounds * of_a_round;
  int less = 0, more = 0;
  for (int n = begin; n < end; ++n) {
    less += turns.eigenvalue(lowest, n) < lowest ? 1 : 0;
    more += turns.eigenvalue(lowest, n) > lowest ? 1 : 0;
  }
  EXPECT_EQ(less, DampingTurns::rounds * DampingTurns::slow_steps);
  EXPECT_EQ(more, DampingTurns::rounds * DampingTurns::quick_steps);
  EXPECT_EQ(turns.eigenvalue(lowest, end), lowest);
}

TEST(DampingTurns, BringMotionsDownSoonerThatAreSlowerThanTheEigenvalueHeld) {
  EXPECT_LT(1.3 * steps_of_modes(lowest / 2, begun()), steps_of_modes(lowest / 2, {}));
}

/// Rates as they are measured at the end of the first round.
TEST(DampingTurns, TellTheRateOfWhatTheyLeave) {
  const DampingTurns turns = begun();
  constexpr int end = begin + DampingTurns::slow_steps + DampingTurns::quick_steps;
  const double told = turns.slowest(lowest, end - 1);
  EXPECT_LT(told, 1);
  for (double eigenvalue = lowest / 2; eigenvalue < lowest; eigenvalue *= 1.1) {
    const auto [now, before] = left_of_mode(eigenvalue, end, turns);
    EXPECT_LT(now / before, told) << eigenvalue;
  }
}

/// Of a slow rigid motion, wherever relaxation may end.
TEST(DampingTurns, ARigidMotionHasNoMoreToGoThanIsSaid) {
  constexpr int span = 8, end = begin + DampingTurns::rounds * (DampingTurns::slow_steps + DampingTurns::quick_steps);
  const DampingTurns turns = begun();
  int asked = 0;
  for (const double of_rigid : {2e-5, 1.2e-4, 4e-4}) {
    for (int now = begin + settled_window; now < end; now += settled_window) {
      if (turns.may_end(now)) {
        const double left = left_of_mode(of_rigid, now, turns).first;
        const double went = left_of_mode(of_rigid, now - span, turns).first - left;
        const double eigenvalue = turns.largest_eigenvalue(lowest, now - span, now);
        EXPECT_LT(0.95 * left, left_of_rigid(went, span, eigenvalue, of_rigid)) << now << ' ' << of_rigid;
        ++asked;
      }
    }
  }
  EXPECT_GT(asked, 100);
}

}  // namespace brainshift::solve::damping_turns_test
