// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/libraries.hpp"

#include <gtest/gtest.h>
#include <omp.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPoints.h>

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
