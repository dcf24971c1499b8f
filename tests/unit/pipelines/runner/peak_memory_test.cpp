// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/peak_memory.hpp"

#include <gtest/gtest.h>

#include <limits>

#include <sys/mman.h>
#include "tests/unit/pipelines/run_folder.hpp"

#include <cmath>

namespace brainshift::pipelines::peak_memory_test {

/// Holds so many MB for a moment, every page of them touched; taken from the system, which has them back at once.
void hold(std::size_t megabytes) {
  const std::size_t size = megabytes << 20;
  void* const held = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(held, MAP_FAILED);
  volatile char* const bytes = static_cast<char*>(held);
  for (std::size_t i = 0; i < size; i += 1024) {
    bytes[i] = 1;
  }
  munmap(held, size);
}

TEST(PeakMemory, RemembersWhatWasHeldForAMoment) {
  reset_peak_memory();
  const double before = peak_memory_mb();
  if (before == 0) {
    GTEST_SKIP() << "the system does not say";
  }
  hold(200);
  EXPECT_GT(peak_memory_mb(), 200);
  EXPECT_LT(peak_memory_mb(), before + 260);
}

TEST(PeakMemory, BeginsAnewWhereTheSystemCan) {
  hold(200);
  const double high = peak_memory_mb();
  reset_peak_memory();
  const double after = peak_memory_mb();
  if (after == high) {
    GTEST_SKIP() << "the system does not reset it";
  }
  EXPECT_LT(after, high - 100);
}

TEST(PeakMemory, WhatCanBeHadIsMoreThanNothing) {
  const double available = available_memory_mb();
  EXPECT_GT(available, 1);
  EXPECT_FALSE(std::isnan(available));
}

/// The run's folder stands for /sys/fs/cgroup.
class MemoryLimit : public RunFolder {};

TEST_F(MemoryLimit, OfAControlGroupOfEitherVersionIsRead) {
  write("job/memory.max", "1073741824\n");
  write("free/memory.max", "max\n");
  write("memory/job/memory.limit_in_bytes", "536870912\n");
  EXPECT_EQ(memory_limit_mb("0::/job\n", folder_), 1024);
  EXPECT_EQ(memory_limit_mb("0::/free\n", folder_), std::numeric_limits<double>::infinity());
  EXPECT_EQ(memory_limit_mb("5:memory:/job\n", folder_), 512);
}

}  // namespace brainshift::pipelines::peak_memory_test
