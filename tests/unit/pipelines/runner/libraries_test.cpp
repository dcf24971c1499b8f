// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/libraries.hpp"

#include <gtest/gtest.h>
#include <omp.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPoints.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <thread>
#include <utility>

namespace brainshift::pipelines::libraries_test {

TEST(Libraries, TakeAsManyThreadsAsTheyAreTold) {
  const int before = threads_in_use();
  for (const int threads : {1, 3}) {
    set_threads(threads);
    EXPECT_EQ(threads_in_use(), threads);
    int team = 0;
#pragma omp parallel
#pragma omp single
    team = omp_get_num_threads();
    EXPECT_EQ(team, threads);
  }
  set_threads(before);
}

/// Of the calling thread by Linux' sched_getattr(2): nice value, and the length of a turn, ns; 0 before Linux 6.12.
std::pair<std::int32_t, std::uint64_t> scheduling() {
  std::array<char, 48> attributes{};
  std::pair<std::int32_t, std::uint64_t> found{};
  if (syscall(SYS_sched_getattr, 0, attributes.data(), attributes.size(), 0) == 0) {
    std::memcpy(&found.first, attributes.data() + 16, sizeof(found.first));
    std::memcpy(&found.second, attributes.data() + 24, sizeof(found.second));
  }
  return found;
}

TEST(Libraries, TakeShortTurnsAtTheSamePriority) {
  if (scheduling().second == 0) {
    GTEST_SKIP() << "this system does not let a process choose the length of its turns";
  }
  const int nice = getpriority(PRIO_PROCESS, 0);
  std::thread([&] {
    take_short_turns();
    std::thread([&] {
      EXPECT_EQ(scheduling().second, 100000U) << "inherited";
      EXPECT_EQ(scheduling().first, nice);
    }).join();
  }).join();
  EXPECT_NE(scheduling().second, 100000U) << "of the thread that asks alone, and of those that it makes";
}

TEST(Libraries, SayNothingOnceTheyAreSilenced) {
  const int before = vtkObject::GetGlobalWarningDisplay();
  vtkObject::SetGlobalWarningDisplay(1);
  silence_libraries();
  testing::internal::CaptureStderr();
  vtkGenericWarningMacro("a library's own warning");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  vtkObject::SetGlobalWarningDisplay(before);
}

}  // namespace brainshift::pipelines::libraries_test
