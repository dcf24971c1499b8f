// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/require_gpu.hpp"

#include <gtest/gtest.h>

#include "solve/device/device_fault.hpp"
#include "solve/device/gpu.hpp"
#include "tests/unit/expect_parts.hpp"

namespace brainshift::pipelines::require_gpu_test {

using test::expect_parts;

/// What is said of the stages from `from` to `until`; empty: nothing.
std::string said(const Scene& scene, StageId from, StageId until) {
  try {
    require_gpu(scene, from, until);
  } catch (const solve::device::NotOnDevice& error) {
    return error.what();
  }
  return {};
}

TEST(RequireGpu, IsOfStagesThatAreToBeMadeOnAGpuAlone) {
  if (solve::device::why_no_gpu().empty()) {
    GTEST_SKIP() << "there is a GPU";
  }
  Scene scene;
  scene.image.t1 = "t1.nii.gz";
  EXPECT_EQ(said(scene, StageId::segment, StageId::report), "");
  scene.solve.device = solve::Device::automatic;
  EXPECT_EQ(said(scene, StageId::segment, StageId::report), "");
  scene.registration.device = solve::Device::cuda;
  EXPECT_EQ(said(scene, StageId::segment, StageId::solve), "");
  EXPECT_EQ(said(scene, StageId::report, StageId::report), "");
  expect_parts(said(scene, StageId::segment, StageId::report), {"register.device cuda: ", "take cpu, or auto"});
  scene.solve.device = solve::Device::cuda;
  expect_parts(said(scene, StageId::segment, StageId::report), {"solve.device cuda: "});
  scene.commands[index_of(StageId::solve)] = "other {in} {out}";
  expect_parts(said(scene, StageId::segment, StageId::report), {"register.device cuda: "});
}

}  // namespace brainshift::pipelines::require_gpu_test
