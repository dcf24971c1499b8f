// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/step_threads.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <functional>

namespace brainshift::solve {
namespace {

/// Windows that ran on each number of threads, of so many on a machine where a step takes as long as `seconds` says.
std::vector<int> windows_on(ThreadChoice& choice, int threads, int windows, const std::function<double(int)>& seconds,
                            double put_aside) {
  std::vector<int> count(17, 0);
  for (int i = 0; i < windows; ++i) {
    ++count[static_cast<std::size_t>(threads)];
    threads = choice.next(seconds(threads), threads > 1 ? put_aside : 0);
  }
  return count;
}

double alone(int threads) {
  return 1.0 / threads;
}

TEST(ThreadChoice, StaysWithAllThreadsWhereNothingDisturbs) {
  ThreadChoice choice(2);
  EXPECT_EQ(windows_on(choice, 2, 200, alone, 0)[2], 200);
}

TEST(ThreadChoice, TakesOneThreadWhereTheSecondHoldsItUpAndRarelyLooksAgain) {
  ThreadChoice choice(2);
  const auto count = windows_on(
      choice, 2, 200, [](int threads) { return threads == 1 ? 1.0 : 1.7; }, 10);
  EXPECT_LT(count[2], 10);
}

TEST(ThreadChoice, TakesAllAgainOnceTheOtherProgramHasEnded) {
  ThreadChoice choice(2);
  windows_on(
      choice, 2, 20, [](int threads) { return threads == 1 ? 1.0 : 1.7; }, 10);
  const auto count = windows_on(choice, 1, 100, alone, 0);
  EXPECT_GT(count[2], 60);
}

TEST(ThreadChoice, KeepsAllThreadsWhereFewerAreSlowerHoweverOftenTheyArePutAside) {
  ThreadChoice choice(2);
  EXPECT_GT(windows_on(
                choice, 2, 200, [](int threads) { return 1.4 / threads; }, 10)[2],
            190);
}

TEST(ThreadChoice, NoticesStepsThatTakeLongerThoughNoThreadOfItsOwnWasPutAside) {
  ThreadChoice choice(2);
  windows_on(choice, 2, 20, alone, 0);
  EXPECT_GT(windows_on(
                choice, 2, 100, [](int threads) { return threads == 1 ? 1.0 : 1.7; }, 0)[1],
            80);
}

/// Sixteen processors of which another program takes four: on more than twelve threads all wait for those put aside.
TEST(ThreadChoice, OfManyThreadsGivesUpThoseThatArePutAside) {
  ThreadChoice choice(16);
  const auto count = windows_on(
      choice, 16, 300, [](int threads) { return threads > 12 ? 2.0 / threads : 1.0 / threads; }, 10);
  EXPECT_GT(count[12], 250);
}

TEST(StepThreads, LeavesTheNumberOfThreadsAsItWas) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(2);
  {
    StepThreads threads;
    for (int step = 0; step < 100; ++step) {
      threads.begin_step();
      threads.end_step();
    }
    omp_set_num_threads(1);
  }
  EXPECT_EQ(omp_get_max_threads(), 2);
  omp_set_num_threads(before);
}

}  // namespace
}  // namespace brainshift::solve
