// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/update/departures.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace brainshift::solve::departures_test {

constexpr std::size_t body_nodes = 3;

/// Four loaded nodes of which one wave, alike at all, is known.
Responses one_wave() {
  return {.nodes = {0, 1, 2, 3}, .waves = {0.5, 0.5, 0.5, 0.5}, .parameters = std::vector<float>(9 * body_nodes)};
}

/// Moves all four nodes by `even`, mm along x and y, and the first two against the others by `across` along z.
Points change_by(double even_x, double even_y, double across) {
  Points change(4, 3);
  change << even_x, even_y, across, even_x, even_y, across, even_x, even_y, -across, even_x, even_y, -across;
  return change;
}

/// Of a body whose nodes answer with squares of the one and in proportion to the other, mm.
NodalVectors answer_to(const Points& change) {
  const double x = change(0, 0), y = change(0, 1), across = change(0, 2);
  NodalVectors answer(4 * body_nodes, 0.0);
  for (std::size_t a = 0; a < body_nodes; ++a) {
    const double share = 0.1 * static_cast<double>(a + 1);
    at(answer, a) << share * x * x, share * x * y, share * across, 0;
  }
  return answer;
}

const NodalVectors nothing(4 * body_nodes, 0.0);

NodalVectors expected(const Departures& departures, const Points& change) {
  NodalVectors start = nothing;
  departures.add_expected(one_wave(), change, start);
  return start;
}

void learn(Departures& departures, const Points& change) {
  departures.learn(one_wave(), change, nothing, answer_to(change), 0.01);
}

TEST(Departures, OfNoAnswersAreNone) {
  EXPECT_EQ(expected({}, change_by(1, 0, 0)), nothing);
}

TEST(Departures, SquaresAndShortWavesAreLearned) {
  Departures departures;
  for (const Points& change : {change_by(1, 0, 0), change_by(0, 1, 0), change_by(1, 1, 0), change_by(0, 0, 0.5)}) {
    learn(departures, change);
  }
  for (const Points& change : {change_by(0.5, -0.7, 0), change_by(-0.3, 0.4, 0.2), change_by(0, 0, -0.4)}) {
    EXPECT_LE(longest_difference(expected(departures, change), answer_to(change)), 0.01);
  }
}

/// What relaxation left open of an answer to a small change says nothing of large ones.
TEST(Departures, FarFromAllAnswersAreNotMuchLarger) {
  Departures departures;
  learn(departures, change_by(0.5, 0, 0));
  const double twice = largest_component(expected(departures, change_by(1, 0, 0)));
  EXPECT_NEAR(largest_component(expected(departures, change_by(10, 0, 0))), twice, 1e-6);
  learn(departures, change_by(0, 0, 0.01));
  const double short_twice = largest_component(expected(departures, change_by(0, 0, 0.02)));
  EXPECT_LT(largest_component(expected(departures, change_by(0, 0, 1))), 1.1 * short_twice);  // with its square
}

/// A file may be written anew each second.
TEST(Departures, OfTheSameLoadTheLastCounts) {
  Departures departures;
  learn(departures, change_by(0, 0, 1));
  for (int again = 0; again < 100; ++again) {
    learn(departures, change_by(0.5, 0, 0));
  }
  EXPECT_GT(largest_component(expected(departures, change_by(0, 0, 1))), 0.2);
}

/// An operation may go on for hours.
TEST(Departures, OldAnswersAreForgotten) {
  Departures departures;
  learn(departures, change_by(0, 0, 1));
  EXPECT_GT(largest_component(expected(departures, change_by(0, 0, 1))), 0.2);
  for (int again = 0; again < 100; ++again) {
    learn(departures, change_by(0.1 + 0.01 * again, 0, 0));
  }
  EXPECT_LT(largest_component(expected(departures, change_by(0, 0, 1))), 1e-6);
}

}  // namespace brainshift::solve::departures_test
