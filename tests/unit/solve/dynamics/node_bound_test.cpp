// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/node_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "solve/dynamics/error_bound.hpp"

namespace brainshift::solve::node_bound_test {

/// What a node has still to go to 0, mm, along x.
NodalVectors places(double quick, double slow) {
  return {quick, 0, 0, 0, slow, 0, 0, 0};
}

struct Bounds {
  double of_body, of_nodes;
};

/// Of a node that is quick and begins far off, and one that is slow and begins near, after so many steps.
Bounds after(int steps, int window, double quick_rate, double slow_rate, double slow_at_first) {
  ErrorBound of_body(window);
  NodeBound of_nodes(window);
  const auto at_step = [&](int k) { return places(std::pow(quick_rate, k), slow_at_first * std::pow(slow_rate, k)); };
  for (int k = window; k <= steps; k += window) {
    of_body.add(longest_difference(at_step(k), at_step(k - 1)), 0, true);
    of_nodes.add(at_step(k));
  }
  return {of_body.value(), of_nodes.value()};
}

TEST(NodeBound, SeesASlowNodeBesideAQuickOne) {
  for (const auto& [window, span] : {std::pair(2, 8), std::pair(20, 20)}) {
    const double quick = std::pow(0.4, 1.0 / span), slow = std::pow(0.85, 1.0 / span);
    const int steps = 6 * span;
    const double left = 0.05 * std::pow(slow, steps);
    const Bounds bounds = after(steps, window, quick, slow, 0.05);
    EXPECT_GE(bounds.of_nodes, (1 - 1e-9) * left) << window;
    EXPECT_LE(bounds.of_nodes, 1.01 * left) << window;
  }
}

TEST(NodeBound, OfAGeometricApproachIsWhatIsLeft) {
  const Bounds bounds = after(60, 2, 0.95, 0.95, 0.5);
  EXPECT_NEAR(bounds.of_nodes, std::pow(0.95, 60), 1e-9);
  EXPECT_LE(bounds.of_nodes, bounds.of_body);
}

TEST(NodeBound, ReadsNoMoreThanNineTimesItsWayOffANodeThatDoesNotSlowDown) {
  NodeBound bound(20);
  for (int window = 0; window < 3; ++window) {
    bound.add(places(0.001 * window, 0));
  }
  EXPECT_NEAR(bound.value(), 0.009, 1e-12);
}

TEST(NodeBound, IsZeroOfABodyAtRestAndWhileTooLittleIsKnown) {
  NodeBound bound(20);
  bound.add(places(1, 1));
  bound.add(places(0, 0));
  EXPECT_EQ(bound.value(), 0);
  bound.add(places(0, 0));
  EXPECT_EQ(bound.value(), 0);
  bound.add(places(1, 1));
  EXPECT_GT(bound.value(), 0);
  bound.reset();
  EXPECT_EQ(bound.value(), 0);
}

}  // namespace brainshift::solve::node_bound_test
