// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/new_scene.hpp"

#include <gtest/gtest.h>

#include "pipelines/scene/check_scene.hpp"
#include "pipelines/scene/parse_scene.hpp"
#include "tests/unit/pipelines/scene_file.hpp"

namespace brainshift::pipelines::new_scene_test {

class MakeScene : public SceneFile {
 protected:
  /// A row of voxels of 50 ml; FreeSurfer's numbers one behind the other or what is given.
  std::filesystem::path labels(const std::string& name, const std::vector<std::int16_t>& numbers) const {
    LabelMap map;
    map.geometry.size = {static_cast<int>(numbers.size()), 1, 1};
    map.geometry.spacing = {50, 100, 100};
    map.geometry.spacing.z() = 10;
    map.voxels = numbers;
    write_image(folder_ / name, map);
    return folder_ / name;
  }
  std::filesystem::path t1(int zeros) const {
    ScalarImage image;
    image.geometry.size = {10, 4, 4};
    image.voxels.assign(160, 100);
    std::fill_n(image.voxels.begin(), zeros, 0.0F);
    write_image(folder_ / "t1 & more.nii.gz", image);
    return folder_ / "t1 & more.nii.gz";
  }
  /// The scene that is made parses, and says what its check says.
  std::string fault_of(const NewScene& made) const { return fault(made.text); }
  std::string refusal(const FilesAtHand& files) const {
    try {
      new_scene(files);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return {};
  }
};

const std::vector<std::int16_t> freesurfer = {2, 3, 4, 7, 8, 10, 11, 12, 13, 16, 17, 18, 24, 41, 42, 43};

TEST_F(MakeScene, OfFreeSurfersMapAndPointsPassesItsOwnCheck) {
  const NewScene made = new_scene({.t1 = t1(10),
                                   .labels = labels("a--seg.mgz.nii.gz", freesurfer),
                                   .brain_mask = {},
                                   .tumour = {},
                                   .points = {write_load()}});
  EXPECT_EQ(fault_of(made), "");
  EXPECT_EQ(parse(made.text).image.labels_are, "freesurfer");
  ASSERT_EQ(made.taken.size(), 3U);
  expect_parts(made.taken[0], {"taken for the T1, 10 x 4 x 4 voxels"});
  expect_parts(made.taken[1], {"a--seg.mgz", "FreeSurfer's numbers (16"});
  expect_parts(made.taken[2], {"load.csv", "1 measured displacements"});
  expect_parts(made.text, {"<!--", "<contact/>"});
}

TEST_F(MakeScene, OfOwnNumbersNamesTheTissuesAndTheSkull) {
  const NewScene made = new_scene({.t1 = {},
                                   .labels = labels("own.nii.gz", {0, 1, 1, 1, 1, 1, 1, 1, 2, 5, 0}),
                                   .brain_mask = {},
                                   .tumour = {},
                                   .points = {write_load()}});
  EXPECT_EQ(fault_of(made), "");
  const Scene scene = parse(made.text);
  EXPECT_EQ(scene.tissues.size(), 2U);
  EXPECT_EQ(scene.image.skull_label, 5);
}

TEST_F(MakeScene, TakesASkullStrippedT1ForItsOwnMask) {
  const NewScene made =
      new_scene({.t1 = t1(100), .labels = {}, .brain_mask = {}, .tumour = {}, .points = {write_load()}});
  const Scene scene = parse(made.text);
  EXPECT_EQ(scene.image.brain_mask, scene.image.t1);
}

TEST_F(MakeScene, SaysWhatIsMissing) {
  expect_parts(refusal({.t1 = t1(10), .labels = {}, .brain_mask = {}, .tumour = {}, .points = {}}),
               {"t1 & more", "--labels", "--brain-mask"});
  expect_parts(
      refusal({.t1 = {}, .labels = labels("f.nii.gz", freesurfer), .brain_mask = {}, .tumour = {}, .points = {}}),
      {"nothing would move", "--points"});
  expect_parts(refusal({.t1 = {},
                        .labels = labels("brats.nii.gz", {0, 1, 2, 4}),
                        .brain_mask = {},
                        .tumour = {},
                        .points = {write_load()}}),
               {"brats.nii.gz", "--tumour"});
  expect_parts(refusal({.t1 = {},
                        .labels = labels("other.nii.gz", {0, 100, 2, 4}),
                        .brain_mask = {},
                        .tumour = {},
                        .points = {write_load()}}),
               {"other.nii.gz", "labels_are"});
}

}  // namespace brainshift::pipelines::new_scene_test
