// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/enough_memory.hpp"

#include <gtest/gtest.h>

#include "pipelines/scene/stage_memory.hpp"
#include "tests/unit/expect_parts.hpp"
#include "tests/unit/pipelines/scene_file.hpp"

namespace brainshift::pipelines::enough_memory_test {

/// What is said where so many MiB can be had; empty: nothing.
std::string said(const Scene& scene, double available, StageId from = StageId::segment) {
  try {
    require_memory(scene, from, StageId::report, available);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

class EnoughMemory : public SceneFile {
 protected:
  Scene scene() {
    write_image(folder_ / "labels.nii.gz", block_labels());
    write_load();
    return parse(R"(<scene><image labels="labels.nii.gz"/>
  <tissues><tissue label="1"/><tissue label="3"/></tissues>
  <load><craniotomy file="load.csv"/></load></scene>)");
  }
};

TEST_F(EnoughMemory, IsWhatTheLargestStageMayTake) {
  Scene scene = EnoughMemory::scene();
  EXPECT_EQ(said(scene, 1000), "");
  scene.discretise.nodes = 10000000;
  const double most = *stage_memory(StageId::solve, scene, declared_run_size(scene));
  EXPECT_EQ(said(scene, most / 1.49), "");
  expect_parts(said(scene, most / 1.51), {"solve needs ", "GB can be had", "10.0 million nodes", "discretise.nodes"});
}

TEST_F(EnoughMemory, IsAskedOfStagesAloneThatAreOursAndAreToBeMade) {
  Scene scene = EnoughMemory::scene();
  expect_parts(said(scene, 10), {"segment needs ", "labels.nii.gz", "coarser voxels"});
  scene.commands[index_of(StageId::discretise)] = "other {in} {out}";
  expect_parts(said(scene, 10, StageId::discretise), {"solve needs "});
  expect_parts(said(scene, 10, StageId::report), {"report needs "});
}

}  // namespace brainshift::pipelines::enough_memory_test
