// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/control_groups.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "tests/unit/pipelines/run_folder.hpp"

namespace brainshift::pipelines::control_groups_test {

constexpr double unlimited = std::numeric_limits<double>::infinity();

double number_in(const fs::path& group) {
  double limit = unlimited;
  std::ifstream(group / "limit") >> limit;
  return limit;
}

/// The run's folder stands for /sys/fs/cgroup.
class ControlGroups : public RunFolder {
 protected:
  double of(const std::string& groups) const { return smallest_limit(groups, folder_, "memory", number_in); }
};

TEST_F(ControlGroups, TheSmallestOfAGroupAndThoseAboveItCounts) {
  write("user/limit", "3");
  write("user/job/limit", "5");
  EXPECT_EQ(of("0::/user/job\n"), 3);
  EXPECT_EQ(of("0::/\n"), unlimited);
}

TEST_F(ControlGroups, OfVersion1TheControllersOwnTreeCountsAlone) {
  write("cpu/job/limit", "2");
  write("memory,hugetlb/job/limit", "7");
  EXPECT_EQ(of("4:cpu:/job\n3:memory,hugetlb:/job\n"), 7);
}

TEST_F(ControlGroups, WhatIsNoListOfGroupsLimitsNothing) {
  EXPECT_EQ(of(""), unlimited);
  EXPECT_EQ(of("no groups here"), unlimited);
}

}  // namespace brainshift::pipelines::control_groups_test
