// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/run_size.hpp"

#include <gtest/gtest.h>

#include "tests/unit/pipelines/scene_file.hpp"

namespace brainshift::pipelines::run_size_test {

constexpr const char* text = R"(<scene><image labels="labels.nii.gz"/>
  <tissues><tissue label="1"/><tissue label="3"/></tissues>
  <load><craniotomy file="load.csv"/></load>
  <stage name="discretise" nodes="1000"/></scene>)";

TEST_F(SceneFile, RunSizeIsThatOfTheBrainInTheImages) {
  const LabelMap labels = block_labels();
  write_image(folder_ / "labels.nii.gz", labels);
  write_load();
  const RunSize size = run_size(parse(text));
  EXPECT_EQ(size.voxels, static_cast<double>(labels.voxels.size()));
  EXPECT_EQ(size.label_voxels, size.voxels);
  const auto brain = std::ranges::count_if(labels.voxels, [](std::uint16_t label) { return label == 1 || label == 3; });
  EXPECT_DOUBLE_EQ(size.solve.volume, static_cast<double>(brain) * labels.geometry.voxel_volume());
  EXPECT_EQ(size.solve.nodes, 1000);
  EXPECT_GT(size.solve.pairs, 10 * size.solve.points);
}

TEST_F(SceneFile, RunSizeTakesAStrippedImageForItsOwnMask) {
  const LabelMap labels = block_labels();
  ScalarImage stripped{labels.geometry, std::vector<float>(labels.voxels.size())};
  double brain = 0;
  for (std::size_t i = 0; i < labels.voxels.size(); ++i) {
    stripped.voxels[i] = labels.voxels[i] == 1 ? -13.5F : 0;  // as interpolation leaves some
    brain += labels.voxels[i] == 1 ? 1 : 0;
  }
  write_image(folder_ / "t1.nii.gz", stripped);
  write_load();
  const RunSize size = run_size(parse(R"(<scene><image t1="t1.nii.gz" brain_mask="t1.nii.gz"/>
    <load><craniotomy file="load.csv"/></load></scene>)"));
  EXPECT_DOUBLE_EQ(size.solve.volume, brain * labels.geometry.voxel_volume());
}

/// Voxels alone tell what the images take; how large the brain is, they do not.
TEST_F(SceneFile, DeclaredRunSizeIsTheSameButForTheBrain) {
  write_image(folder_ / "labels.nii.gz", block_labels());
  write_load();
  const Scene scene = parse(text);
  const RunSize read = run_size(scene), declared = declared_run_size(scene);
  EXPECT_EQ(declared.voxels, read.voxels);
  EXPECT_EQ(declared.label_voxels, read.label_voxels);
  EXPECT_EQ(declared.solve.pairs, read.solve.pairs);
  EXPECT_EQ(declared.solve.volume, 1.4e6);
}

}  // namespace brainshift::pipelines::run_size_test
