// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/span_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "solve/dynamics/error_bound.hpp"

namespace brainshift::solve::span_bound_test {

/// What a node has still to go to 0, mm, along x.
NodalVectors places(double quick, double slow) {
  return {quick, 0, 0, 0, slow, 0, 0, 0};
}

struct Bounds {
  double of_body, of_spans;
};

/// Of a node that is quick and begins far off, and one that is slow and begins near, after so many steps.
Bounds after(int steps, int window, double quick_rate, double slow_rate, double slow_at_first) {
  ErrorBound of_body(window);
  SpanBound of_spans(window);
  const auto at_step = [&](int k) { return places(std::pow(quick_rate, k), slow_at_first * std::pow(slow_rate, k)); };
  for (int k = window; k <= steps; k += window) {
    of_body.add(longest_difference(at_step(k), at_step(k - 1)), 0, true);
    of_spans.add(at_step(k));
  }
  return {of_body.value(), of_spans.value()};
}

TEST(SpanBound, SeesASlowNodeBesideAQuickOne) {
  for (const auto& [window, span] : {std::pair(2, 8), std::pair(20, 20)}) {
    const double quick = std::pow(0.4, 1.0 / span), slow = std::pow(0.85, 1.0 / span);
    const int steps = 6 * span;
    const double left = 0.05 * std::pow(slow, steps);
    const Bounds bounds = after(steps, window, quick, slow, 0.05);
    EXPECT_GE(bounds.of_spans, (1 - 1e-9) * left) << window;
    EXPECT_LE(bounds.of_spans, 1.01 * left) << window;
  }
}

TEST(SpanBound, OfAGeometricApproachIsWhatIsLeftAndAThird) {
  const Bounds bounds = after(60, 2, 0.95, 0.95, 0.5);
  EXPECT_NEAR(bounds.of_spans, 4.0 / 3 * std::pow(0.95, 60), 1e-9);
}

/// As a block of ν = 0.4999 between plates does: every node takes part in a quick motion and in a slow one. A node
/// alone tells half of what is left.
TEST(SpanBound, SeesAWholeBodyThatIsSlow) {
  SpanBound bound(20);
  const auto left = [](int k) { return std::pow(0.5, k) + std::pow(0.95, k); };
  for (int k = 0; k <= 20; ++k) {
    bound.add(places(left(k), left(k)));
    if (k > 10) {
      EXPECT_GE(bound.value(), left(k)) << k;
      EXPECT_LE(bound.value(), 1.4 * left(k)) << k;
    }
  }
}

TEST(SpanBound, ReadsNoMoreThanNineTimesItsWayOffANodeThatDoesNotSlowDown) {
  SpanBound bound(20);
  for (const double quick : {1.0, 0.1, 0.1}) {
    bound.add(places(quick, 0.001 * (1 - quick)));
  }
  bound.add(places(0.1, 0.0018));
  EXPECT_NEAR(bound.value(), 9 * 0.0009, 1e-12);
}

TEST(SpanBound, IsZeroOfABodyAtRestAndWhileTooLittleIsKnown) {
  SpanBound bound(20);
  bound.add(places(1, 1));
  bound.add(places(0, 0));
  EXPECT_FALSE(bound.is_known());
  EXPECT_EQ(bound.value(), 0);
  bound.add(places(0, 0));
  EXPECT_TRUE(bound.is_known());
  EXPECT_EQ(bound.value(), 0);
  bound.add(places(1, 1));
  EXPECT_GT(bound.value(), 0);
  bound.reset();
  EXPECT_EQ(bound.value(), 0);
}

}  // namespace brainshift::solve::span_bound_test
