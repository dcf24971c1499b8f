// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/processors.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/pipelines/run_folder.hpp"

namespace brainshift::pipelines::processors_test {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// The run's folder stands for /sys/fs/cgroup.
class ProcessorsTest : public RunFolder {};

TEST_F(ProcessorsTest, AQuotaOfVersion2IsRead) {
  write("cpu.max", "max 100000\n");
  write("job/cpu.max", "150000 100000\n");
  EXPECT_EQ(processor_quota("0::/job\n", folder_), 1.5);
  EXPECT_EQ(processor_quota("0::/\n", folder_), unlimited);
}

TEST_F(ProcessorsTest, TheGroupsAboveCountToo) {
  write("user/cpu.max", "50000 100000\n");
  write("user/job/cpu.max", "300000 100000\n");
  EXPECT_EQ(processor_quota("0::/user/job\n", folder_), 0.5);
}

TEST_F(ProcessorsTest, AQuotaOfVersion1IsRead) {
  write("cpu,cpuacct/job/cpu.cfs_quota_us", "200000\n");
  write("cpu,cpuacct/job/cpu.cfs_period_us", "100000\n");
  write("cpu,cpuacct/cpu.cfs_quota_us", "-1\n");
  write("cpu,cpuacct/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(processor_quota("4:cpuset:/job\n3:cpu,cpuacct:/job\n0::/\n", folder_), 2.0);
}

TEST_F(ProcessorsTest, APathOfTheHostFallsBackOnTheGroupsAbove) {
  write("cpu.max", "100000 100000\n");
  EXPECT_EQ(processor_quota("0::/machine/container-17\n", folder_), 1.0);
}

TEST_F(ProcessorsTest, WithoutGroupsNothingIsLimited) {
  EXPECT_EQ(processor_quota("", folder_), unlimited);
  EXPECT_EQ(processor_quota("no groups here", folder_), unlimited);
}

TEST(Processors, PartOfAProcessorIsOneThread) {
  EXPECT_EQ(threads_for(8, 0.5), 1);
  EXPECT_EQ(threads_for(8, 1.5), 2);
  EXPECT_EQ(threads_for(2, unlimited), 2);
}

}  // namespace brainshift::pipelines::processors_test
