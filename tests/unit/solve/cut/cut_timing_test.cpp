// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/cut_timing.hpp"

#include <gtest/gtest.h>

#include "tests/unit/expect_parts.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::solve::cut_timing_test {

using test::expect_parts;
using test::refusal;

const std::vector<double> distance = {0, 3, 10};

TEST(CutTiming, IsNoneWhereTheBodyIsCutFromTheStart) {
  EXPECT_TRUE(times_along(distance, {}, "cut").empty());
  EXPECT_TRUE(times_along(distance, {.start = 0}, "cut").empty());
}

TEST(CutTiming, OfAStartAloneIsTheStartEverywhere) {
  EXPECT_EQ(times_along(distance, {.start = 0.4}, "cut"), (std::vector<double>{0.4, 0.4, 0.4}));
}

TEST(CutTiming, GoesWithTheDistanceAtASpeed) {
  EXPECT_EQ(times_along(distance, {.speed = 20}, "cut"), (std::vector<double>{0, 0.15, 0.5})) << "from time 0 on";
  EXPECT_EQ(times_along(distance, {.start = 1, .speed = 2}, "cut"), (std::vector<double>{1, 2.5, 6}));
}

TEST(CutTiming, RefusesWhatCannotBe) {
  const auto fault = [](const CutTiming& timing) { return refusal([&] { times_along(distance, timing, "cut 4"); }); };
  expect_parts(fault({.start = -1}), {"cut 4", "start", "-1", ">= 0"});
  expect_parts(fault({.speed = 0}), {"cut 4", "speed", "> 0"});
  expect_parts(fault({.start = 1, .direction = {1, 0, 0}}), {"cut 4", "direction but no speed"});
}

TEST(CutTiming, DoesNotGoWithTimesOfTheFile) {
  const auto fault = [](const CutTiming& timing) { return refusal([&] { refuse_timing(timing, "cut 4"); }); };
  EXPECT_EQ(fault({}), "");
  expect_parts(fault({.start = 0}), {"cut 4", "holds the times"});
  expect_parts(fault({.speed = 1}), {"cut 4", "leave start, speed and direction out"});
  expect_parts(fault({.direction = {0, 0, 1}}), {"cut 4"});
}

}  // namespace brainshift::solve::cut_timing_test
