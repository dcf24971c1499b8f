// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "solve/interface/solution.hpp"
#include "solve/output/solution_file.hpp"
#include "tests/phantoms/heads/head_runs.hpp"

namespace brainshift {
namespace {

TEST(Threads, OneAndTwoThreadsWriteTheSameDisplacementBitForBit) {
  const Solution two = read_solution(oblique_run().folder / "solve/solution.vtu");
  const Solution one = read_solution(one_thread_run().folder / "solve/solution.vtu");
  ASSERT_EQ(one.positions.rows(), two.positions.rows());
  EXPECT_EQ(one.positions, two.positions);
  EXPECT_EQ(one.displacement, two.displacement);
  EXPECT_GT(one.displacement.norm(), 0);
}

}  // namespace
}  // namespace brainshift
