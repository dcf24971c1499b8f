// SPDX-License-Identifier: GPL-3.0-or-later
//
// A synthetic head whose tumour is taken out, from the images to the warped ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "pipelines/phantom/phantom.hpp"
#include "tests/phantoms/program.hpp"

namespace brainshift::resection_test {

TEST(ResectedHead, IsSolvedAndRegistered) {
  const ScratchFolder scratch;
  const pipelines::PhantomOptions head{.size = 44, .spacing = 4.0};
  pipelines::write_phantom(head, scratch / "head");
  const std::string scene = (scratch / "head/scene.xml").string(), folder = (scratch / "run").string();
  const ProgramResult result = run_shell("brainshift run " + scene + " --quiet --out " + folder +
                                         " --set resection.labels=3 --set register.cavity_label=24 --set "
                                         "discretise.tumour_factor=0.4 --set solve.gravity='0 4 0'");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto stages = nlohmann::json::parse(bytes_of(folder + "/run.json"))["stages"];
  const auto& resection = stages["solve"]["measures"]["resection"];
  EXPECT_EQ(stages["solve"]["sizes"]["nodes"].get<int>() + resection["removed_nodes"].get<int>(),
            stages["discretise"]["sizes"]["nodes"]);
  EXPECT_GT(resection["removed_nodes"], 0);
  const LabelMap labels = pipelines::sample_labels(pipelines::make_phantom(head));
  const double volume = static_cast<double>(std::ranges::count(labels.voxels, 3)) * labels.geometry.voxel_volume();
  EXPECT_NEAR(resection["removed_volume_mm3"], volume, 0.05 * volume);
  EXPECT_GT(resection["wall_nodes"], 10);
  EXPECT_GT(resection["cavity_volume_mm3"], 0);
  EXPECT_LT(resection["cavity_volume_mm3"], resection["removed_volume_mm3"]) << "the cortex above it sinks";
  EXPECT_EQ(stages["register"]["status"], "done");
  EXPECT_EQ(stages["register"]["measures"]["folded_voxels"], 0);
  EXPECT_GT(stages["register"]["sizes"]["cavity_voxels"], 0);
  const LabelMap warped = read_label_map(folder + "/register/warped_labels.nii.gz");
  EXPECT_EQ(std::ranges::count(warped.voxels, 3), 0) << "tissue is drawn in the cavity";
  EXPECT_GT(std::ranges::count(warped.voxels, 24), 0);
  const std::string register_again = "brainshift register --solution " + folder + "/solve/solution.vtu --brain " +
                                     folder + "/segment/brain.vtp --t1 " + (scratch / "head/t1.nii.gz").string() +
                                     " --labels " + folder + "/segment/labels.nii.gz --out " + folder + "/again";
  const ProgramResult alone =
      run_shell(register_again + " --wall " + folder + "/segment/resection.vtp --resection 3 --cavity-label 24");
  ASSERT_EQ(alone.code, 0) << alone.err;
  EXPECT_EQ(read_label_map(folder + "/again/warped_labels.nii.gz").voxels, warped.voxels);
}

}  // namespace brainshift::resection_test
