// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/new_scene.hpp"

#include <gtest/gtest.h>

#include "pipelines/scene/check_scene.hpp"
#include "pipelines/scene/parse_scene.hpp"
#include "tests/unit/pipelines/scene_file.hpp"
#include "tests/unit/segmentation/slicer_file.hpp"

namespace brainshift::pipelines::new_scene_test {

class MakeScene : public SceneFile {
 protected:
  /// A row of voxels of 50 ml; FreeSurfer's numbers one behind the other or what is given.
  std::filesystem::path labels(const std::string& name, const std::vector<std::uint16_t>& numbers) const {
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

const std::vector<std::uint16_t> freesurfer = {2, 3, 4, 7, 8, 10, 11, 12, 13, 16, 17, 18, 24, 41, 42, 43};

TEST_F(MakeScene, OfFreeSurfersMapAndPointsPassesItsOwnCheck) {
  const NewScene made = new_scene({.t1 = t1(10),
                                   .labels = labels("a--seg.mgz.nii.gz", freesurfer),
                                   .labels_are = {},
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
                                   .labels_are = {},
                                   .brain_mask = {},
                                   .tumour = {},
                                   .points = {write_load()}});
  EXPECT_EQ(fault_of(made), "");
  const Scene scene = parse(made.text);
  EXPECT_EQ(scene.tissues.size(), 2U);
  EXPECT_EQ(scene.image.skull_label, 5);
}

TEST_F(MakeScene, RefusesVentriclesThatAreLargerThanAny) {
  const std::string fault =
      refusal({.t1 = {},
               .labels = labels("grey_and_white.nii.gz", {0, 1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2}),
               .labels_are = {},
               .brain_mask = {},
               .tumour = {},
               .points = {write_load()}});
  expect_parts(fault, {"grey_and_white.nii.gz", "label 2 holds", "rare for ventricles", "--labels-are"});
}

TEST_F(MakeScene, OfAMapWithATableNamesTheTable) {
  const auto map = labels("sub-1_dseg.nii.gz", {0, 40000, 40000, 40000, 7, 0});
  std::ofstream(folder_ / "own.txt") << "40000 Brain\n7 Ventricle\n";
  FilesAtHand files;
  files.labels = map;
  files.points = {write_load()};
  files.labels_are = (folder_ / "own.txt").string();
  const NewScene named = new_scene(files);
  EXPECT_EQ(fault_of(named), "");
  EXPECT_EQ(parse(named.text).image.labels_are, files.labels_are);
  expect_parts(named.taken[0], {"sub-1_dseg.nii.gz", "own.txt", "parenchyma 150 ml, ventricles 50 ml"});
  for (const char* beside : {"sub-1_dseg_ColorTable.ctbl", "sub-1_dseg.ctbl", "sub-1_dseg.tsv"}) {
    std::ofstream(folder_ / beside) << (std::string(beside).ends_with("tsv")
                                            ? "index\tname\n40000\tBrain\n7\tVentricle\n"
                                            : "40000 Brain 1 2 3 0\n7 Ventricle 1 2 3 0\n");
    files.labels_are.clear();
    const NewScene found = new_scene(files);
    EXPECT_EQ(fault_of(found), "");
    EXPECT_EQ(parse(found.text).image.labels_are, (folder_ / beside).string());
  }
  files.labels_are = "brats";
  expect_parts(refusal(files), {"sub-1_dseg.nii.gz", "no voxel is brain"});
  files.labels.clear();
  expect_parts(refusal(files), {"--labels-are", "--labels"});
}

TEST_F(MakeScene, OfSegmentsOf3DSlicerGoesByTheirNames) {
  FilesAtHand files;
  files.labels = test::write_slicer_file(
      folder_ / "a.seg.nrrd", test::slicer_segment(0, "Brain", 1, 0) + test::slicer_segment(1, "Tumour", 1, 1),
      {{1, 1, 0}, {0, 1, 0}});
  files.points = {write_load()};
  const NewScene made = new_scene(files);
  EXPECT_EQ(fault_of(made), "");
  EXPECT_EQ(parse(made.text).image.labels_are, "");
  expect_parts(made.taken[0], {"a.seg.nrrd", "3D Slicer", "parenchyma 10 ml, tumour 10 ml"});
}

TEST_F(MakeScene, DoesNotGuessWhetherAnImageIsOfABrainOrAHeadAlone) {
  FilesAtHand files{
      .t1 = t1(100), .labels = {}, .labels_are = {}, .brain_mask = {}, .tumour = {}, .points = {write_load()}};
  expect_parts(refusal(files), {"t1 & more", "not which voxels are brain", "second time, as --brain-mask"});
  files.brain_mask = files.t1;
  const Scene scene = parse(new_scene(files).text);
  EXPECT_EQ(scene.image.brain_mask, scene.image.t1);
}

TEST_F(MakeScene, TablesOfDisplacementsAreNoPair) {
  const std::filesystem::path load = write_load();
  const FilesAtHand files{.t1 = {},
                          .labels = labels("f.nii.gz", freesurfer),
                          .labels_are = {},
                          .brain_mask = {},
                          .tumour = {},
                          .points = {load, load}};
  expect_parts(refusal(files), {"load.csv", "holds displacements", "give it alone"});
}

TEST_F(MakeScene, SaysWhatIsMissing) {
  expect_parts(refusal({.t1 = t1(10), .labels = {}, .labels_are = {}, .brain_mask = {}, .tumour = {}, .points = {}}),
               {"t1 & more", "--labels", "--brain-mask"});
  expect_parts(refusal({.t1 = {},
                        .labels = labels("f.nii.gz", freesurfer),
                        .labels_are = {},
                        .brain_mask = {},
                        .tumour = {},
                        .points = {}}),
               {"nothing would move", "--points"});
  expect_parts(refusal({.t1 = {},
                        .labels = labels("brats.nii.gz", {0, 1, 2, 4}),
                        .labels_are = {},
                        .brain_mask = {},
                        .tumour = {},
                        .points = {write_load()}}),
               {"brats.nii.gz", "--tumour"});
  expect_parts(refusal({.t1 = {},
                        .labels = labels("other.nii.gz", {0, 100, 2, 4}),
                        .labels_are = {},
                        .brain_mask = {},
                        .tumour = {},
                        .points = {write_load()}}),
               {"other.nii.gz", "--labels-are"});
}

}  // namespace brainshift::pipelines::new_scene_test
