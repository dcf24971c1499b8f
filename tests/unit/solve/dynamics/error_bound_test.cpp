// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/error_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace brainshift::solve::error_bound_test {

constexpr int window = 10;  // steps between two looks

/// The bound after so many looks at steps that shrink by `rate` each.
ErrorBound after(int looks, double rate, double damping_rate = 0) {
  ErrorBound bound(window);
  for (int k = 0; k < looks; ++k) {
    bound.add(std::pow(rate, k * window), damping_rate, true);
  }
  return bound;
}

/// What the steps after this one add up to is ρ/(1 − ρ) of it. A critically damped motion falls more slowly at first.
TEST(ErrorBound, OfAGeometricApproachIsAtMostTwiceTheErrorAndFallsAsItDoes) {
  for (const double rate : {0.9, 0.99}) {
    for (const int looks : {10, 20, 40}) {
      const double error = rate / (1 - rate) * std::pow(rate, (looks - 1) * window);
      EXPECT_GE(after(looks, rate, rate).value(), error);
      EXPECT_GE(after(looks, rate).value(), error);
      EXPECT_LE(after(looks, rate).value(), (1 + 1e-9) * error) << "nothing slower was seen";
    }
  }
  const double error = 99 * std::pow(0.99, 39 * window);
  EXPECT_GE(after(40, 0.99, 0.99).value(), 1.8 * error);
  EXPECT_LE(after(40, 0.99, 0.99).value(), 2 * error);
}

TEST(ErrorBound, IsInfiniteUntilFourBoundsAreKnown) {
  EXPECT_TRUE(std::isinf(after(7, 0.9).value()));
  EXPECT_TRUE(std::isfinite(after(8, 0.9).value()));
  ErrorBound bound = after(20, 0.9);
  bound.reset();
  EXPECT_TRUE(std::isinf(bound.value()));
  for (int k = 0; k < 7; ++k) {
    bound.add(1, 0.9, true);
  }
  EXPECT_TRUE(std::isinf(bound.value())) << "what was before does not count";
}

TEST(ErrorBound, DoesNotCountUntilTheWholeLoadIsOn) {
  ErrorBound bound(window);
  for (int k = 0; k < 30; ++k) {
    bound.add(std::pow(0.9, k * window), 0.5, false);
  }
  for (int k = 0; k < 7; ++k) {
    bound.add(std::pow(0.9, k * window), 0.5, true);
    EXPECT_TRUE(std::isinf(bound.value())) << "rates of which the first step was the load's";
  }
  bound.add(std::pow(0.9, 7 * window), 0.5, true);
  EXPECT_TRUE(std::isfinite(bound.value()));
}

TEST(ErrorBound, StandsStillWhereRoundingKeepsTheStepsAlike) {
  constexpr double rounding = 1e-6;
  ErrorBound bound = after(10, 0.9);
  for (int k = 0; k < ErrorBound::standstill / window; ++k) {
    EXPECT_FALSE(bound.stands_still(rounding)) << k;
    bound.add(k % 3 == 0 ? 0.9e-6 : 0.5e-6, 0, true);
  }
  EXPECT_TRUE(bound.stands_still(rounding));
  EXPECT_FALSE(bound.stands_still(0.8e-6)) << "larger than rounding: something else moves";
  EXPECT_FALSE(after(100, 0.998).stands_still(1)) << "slow, but it comes nearer";
}

/// Windows of an update are short: forty steps alike are no standstill.
TEST(ErrorBound, StandsStillAfterAsManyStepsWhateverTheWindow) {
  constexpr int short_window = 2;
  ErrorBound bound(short_window);
  for (int step = 0; step < ErrorBound::standstill; step += short_window) {
    EXPECT_FALSE(bound.stands_still(1e-6)) << step;
    bound.add(1e-6, 0, true);
  }
  EXPECT_TRUE(bound.stands_still(1e-6));
}

TEST(ErrorBound, AtAStandstillIsWhatTheSlowestMotionHasStillToGo) {
  ErrorBound bound = after(10, 1.0);
  for (int k = 0; k < ErrorBound::standstill / window; ++k) {
    bound.add(k % 3 == 0 ? 2e-9 : 1e-9, 0.9, true);
  }
  EXPECT_NEAR(bound.at_standstill(0.999), 999 * 2e-9, 1e-12);
  EXPECT_EQ(bound.value(), bound.at_standstill(0.999));
}

TEST(ErrorBound, MeasuresNoRateOfRounding) {
  ErrorBound bound(window);
  for (int k = 0; k < 8; ++k) {
    bound.add(k % 2 == 0 ? 1e-15 : 1.5e-15, 0.9, true, 1e-14);
  }
  EXPECT_NEAR(bound.value(), 9 * 1.5e-15, 1e-16);
}

TEST(ErrorBound, TakesTheSlowerOfTheMeasuredRateAndThatOfTheDamping) {
  const auto before_last = [](int looks) { return std::pow(0.9, (11 - looks) * window); };
  const double left = (1 + 30 / 30.0) * std::pow(29 / 30.0, 30);
  const double earliest = 29 * before_last(3) * left, latest = 9 * before_last(0);
  EXPECT_NEAR(after(12, 0.9, 29 / 30.0).value(), earliest, 1e-9 * earliest) << "of the last four";
  EXPECT_NEAR(after(12, 0.9, 0.5).value(), latest, 1e-9 * latest);
}

TEST(ErrorBound, IsNotTakenInByAPassingLow) {
  ErrorBound bound = after(20, 0.99, 0.99);
  const double before = bound.value();
  bound.add(1e-9, 0, true);
  EXPECT_GT(bound.value(), 0.9 * before);
}

/// A slow motion turns within more than four windows. While it does, the body seems quick and near its end.
TEST(ErrorBound, RemembersASlowMotionAsLongAsItLasts) {
  constexpr double slow = 1 - 1 / 200.0, quicker = 1 - 1 / 70.0;
  ErrorBound bound = after(20, 0.99, slow);
  for (int k = 0; k < 8; ++k) {
    bound.add(1e-6 * std::pow(0.9, k * window), quicker, true);
  }
  EXPECT_GT(bound.value(), 1);
  for (int k = 8; k < 40; ++k) {
    bound.add(1e-6 * std::pow(0.9, k * window), quicker, true);
  }
  EXPECT_LT(bound.value(), 1e-12);
}

/// As in an ellipsoid pressed in by a disc (tests/random, small, seed 312), which rocks behind quicker motions.
TEST(ErrorBound, IsAsManyTimesLargerAsTheLowestEigenvalueHasBecomeLess) {
  const auto spans_count = [](double fall) {
    constexpr double root = 0.05;  // √(αA_0) before
    ErrorBound bound = after(20, 0.8, 1 - root);
    bound.add(1e-20, 1 - root / std::sqrt(fall), true);
    return bound.with_spans(1);
  };
  EXPECT_NEAR(spans_count(2.5), 2.5 * spans_count(1), 1e-9);
  EXPECT_NEAR(spans_count(1.4), spans_count(1), 1e-9) << "that may be chance";
  EXPECT_NEAR(spans_count(0.1), spans_count(1), 1e-9) << "it rises";
}

TEST(ErrorBound, CountsSpansHalfAsMuchAgainButNearTheEnd) {
  const ErrorBound bound = after(20, 0.8, 0.9);
  EXPECT_EQ(bound.with_spans(0), bound.value());
  EXPECT_EQ(bound.with_spans(1), 1.5);
  EXPECT_EQ(bound.with_spans(1, true), 1);
}

TEST(ErrorBound, IsInfiniteWhereStepsDoNotShrink) {
  EXPECT_TRUE(std::isinf(after(30, 1.0).value()));
  EXPECT_TRUE(std::isinf(after(30, 1.01).value()));
}

TEST(ErrorBound, OfABodyThatDoesNotMoveIsZero) {
  ErrorBound bound(window);
  for (int k = 0; k < 8; ++k) {
    bound.add(0, 0.9, true);
  }
  EXPECT_EQ(bound.value(), 0);
}

}  // namespace brainshift::solve::error_bound_test
