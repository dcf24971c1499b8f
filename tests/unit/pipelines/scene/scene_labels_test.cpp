// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/scene_labels.hpp"

#include <gtest/gtest.h>

#include "tests/unit/pipelines/scene_file.hpp"
#include "tests/unit/segmentation/slicer_file.hpp"

namespace brainshift::pipelines::scene_labels_test {

/// FreeSurfer's numbers one behind the other, and two that it does not know.
LabelMap freesurfer_labels() {
  LabelMap map;
  map.voxels = {2, 3, 4, 7, 8, 10, 11, 12, 13, 16, 17, 18, 24, 41, 42, 43, 507, 136, 0, 0};
  map.geometry.size = {20, 1, 1};
  return map;
}

class SceneLabels : public SceneFile {
 protected:
  ImageInputs image_of(const LabelMap& map, const std::string& labels_are = "") const {
    write_image(folder_ / "labels.nii.gz", map);
    ImageInputs image;
    image.labels = folder_ / "labels.nii.gz";
    image.labels_are = labels_are;
    return image;
  }
  std::string fault_of(const ImageInputs& image) const {
    try {
      read_labels(image, {.by_class = true, .joined = {}});
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return {};
  }
};

TEST_F(SceneLabels, FreeSurfersNumbersAreRecognisedSaidAndReadByClass) {
  const auto read = read_labels(image_of(freesurfer_labels()), {.by_class = true, .joined = {}});
  EXPECT_EQ(read.map.voxels, (std::vector<std::uint16_t>{1, 1, 2, 1, 1, 1, 1, 1, 1, 1, 1, 1, 4, 1, 1, 2, 0, 0, 0, 0}));
  ASSERT_EQ(read.notes.size(), 2U);
  expect_parts(read.notes[0], {"labels.nii.gz", "taken for FreeSurfer's", "labels_are"});
  expect_parts(read.notes[1], {"136 (0 ml)", "507 (0 ml)", "not brain"});
  EXPECT_EQ(read_labels(image_of(freesurfer_labels(), "freesurfer"), {.by_class = true, .joined = {}}).notes.size(),
            1U);
}

TEST_F(SceneLabels, OtherNumbersNeedATable) {
  expect_parts(fault_of(image_of(block_labels())), {"labels.nii.gz", "1 3 6", "labels_are"});
  LabelMap tumour_alone = block_labels();
  tumour_alone.at(2, 1, 1) = 1;
  expect_parts(fault_of(image_of(tumour_alone, "freesurfer")), {"no voxel is brain", "FreeSurfer's"});
  tumour_alone.at(1, 2, 1) = 4;
  expect_parts(fault_of(image_of(tumour_alone, "brats")), {"no voxel is brain", "tumour="});
  std::ofstream(folder_ / "own.txt") << "1 Brain\n3 Ventricle\n6 Skin\n";
  const auto own =
      read_labels(image_of(block_labels(), (folder_ / "own.txt").string()), {.by_class = true, .joined = {}});
  EXPECT_EQ(own.map.at(1, 1, 1), 1);
  EXPECT_EQ(own.map.at(2, 1, 1), 2);
  EXPECT_EQ(own.map.at(1, 2, 1), 6) << "no number is fluid or skull, so the skin stays";
  ASSERT_EQ(own.notes.size(), 1U);
  expect_parts(own.notes.front(), {"parenchyma 1, ventricles 3", "own.txt"});
}

TEST(LabelNames, AreThoseOfTheTissuesElseTheUsualOnes) {
  Scene scene;
  scene.tissues.resize(2);
  scene.tissues[0].label = 1;
  scene.tissues[1].label = 12;
  scene.tissues[1].name = "falx";
  const auto names = label_names(scene);
  EXPECT_EQ(names.at(1), "parenchyma") << "this tissue has no name of its own";
  EXPECT_EQ(names.at(4), "fluid");
  EXPECT_EQ(names.at(12), "falx");
}

TEST_F(SceneLabels, NumbersOfTheUsersOwnAreNotCalledByOurs) {
  const auto named = [&](const std::string& image) {
    return label_names(parse("<scene><image labels=\"l.nii\" " + image +
                             "/><tissues><tissue label=\"2\" material=\"brain\"/>"
                             "<tissue label=\"5\" material=\"tumour\"/></tissues></scene>"));
  };
  using Names = std::map<std::uint16_t, std::string>;
  EXPECT_EQ(named("other_labels=\"3 6\" skull_label=\"3\""), (Names{{2, "brain"}, {3, "skull"}, {5, "tumour"}}));
  EXPECT_EQ(named(""), (Names{{2, "brain"}, {4, "fluid"}, {5, "tumour"}, {6, "skin"}}));
}

TEST_F(SceneLabels, WhatIsNoLabelMapIsRefusedWithASentence) {
  struct Case {
    float value;
    std::vector<std::string> said;
  };
  for (const Case& bad : {Case{0.25F, {"holds 0.25", "probabilities"}},
                          {3.5F, {"holds 3.5", "round"}},
                          {70000.0F, {"holds 70000", "renumber"}},
                          {-7.0F, {"holds -7", "unsigned"}}}) {
    const LabelMap good = freesurfer_labels();
    ScalarImage image{good.geometry, {good.voxels.begin(), good.voxels.end()}};
    image.voxels[3] = bad.value;
    ImageInputs inputs;
    inputs.labels = folder_ / "bad.nii.gz";
    write_image(inputs.labels, image);
    auto said = bad.said;
    said.push_back("bad.nii.gz");
    const std::string fault = fault_of(inputs);
    for (const std::string& part : said) {
      EXPECT_NE(fault.find(part), std::string::npos) << fault;
    }
    image.voxels[3] = 7.0F;
    write_image(inputs.labels, image);
    EXPECT_EQ(fault_of(inputs), "") << "whole numbers of a floating type are labels";
  }
}

TEST_F(SceneLabels, SegmentsOf3DSlicerAreReadByTheirNamesAndBeforeThemWhatTheUserSays) {
  ImageInputs image;
  image.labels = test::write_slicer_file(
      folder_ / "a.seg.nrrd", test::slicer_segment(0, "Brain", 1, 0) + test::slicer_segment(1, "Ventricles", 1, 1),
      {{1, 1, 0}, {0, 1, 0}});
  EXPECT_TRUE(classes_are_told(image));
  const auto read = read_labels(image, {.by_class = true, .joined = {}});
  EXPECT_EQ(read.map.voxels, (std::vector<std::uint16_t>{1, 2, 0}));
  ASSERT_EQ(read.notes.size(), 2U);
  expect_parts(read.notes[1], {"'Ventricles' lies over 'Brain' in 10 ml"});
  image.labels_are = "brats";
  expect_parts(fault_of(image), {"a.seg.nrrd", "both have the number 1"});
  image.labels_are = "";
  test::write_slicer_file(image.labels, test::slicer_segment(0, "Segment_1", 1, 0), {{1, 0}});
  EXPECT_FALSE(classes_are_told(image));
  expect_parts(fault_of(image), {"a.seg.nrrd", "not FreeSurfer's"});
  test::write_slicer_file(image.labels, test::slicer_segment(0, "Skull", 1, 0), {{1, 0}});
  expect_parts(fault_of(image), {"no voxel is brain", "rename"});
}

TEST_F(SceneLabels, AHemisphereThatIsMissingIsTold) {
  LabelMap map = freesurfer_labels();
  for (std::uint16_t& label : map.voxels) {
    label = label == 41 || label == 42 ? std::uint16_t{0} : label;
  }
  const auto notes = read_labels(image_of(map, "freesurfer"), {.by_class = true, .joined = {}}).notes;
  ASSERT_EQ(notes.size(), 2U);
  expect_parts(notes[1], {"warning", "right hemisphere"});
}

TEST_F(SceneLabels, AHemisphereOfDestrieuxRegionsThatIsMissingIsTold) {
  LabelMap map = freesurfer_labels();
  for (std::uint16_t& label : map.voxels) {
    label = label == 2 || label == 3 ? 0 : label == 41 || label == 42 ? 12101 : label;
  }
  const auto notes = read_labels(image_of(map, "freesurfer"), {.by_class = true, .joined = {}}).notes;
  ASSERT_FALSE(notes.empty());
  expect_parts(notes.back(), {"warning", "left hemisphere"});
}

/// Half a brain is thinner for its length than a whole one, in whatever direction.
TEST_F(SceneLabels, OneNumberForBothHemispheresIsNoMissingOne) {
  LabelMap map;
  map.geometry.size = {20, 28, 20};
  map.geometry.spacing.setConstant(6);
  map.voxels.assign(20 * 28 * 20, 0);
  map.at(0, 0, 0) = 4;
  const auto notes_of = [&](int width, std::uint16_t first, std::uint16_t second) {
    for (int k = 2; k < 18; ++k) {
      for (int j = 2; j < 26; ++j) {
        for (int i = 2; i < 18; ++i) {
          map.at(i, j, k) = i >= 2 + width ? std::uint16_t{4} : j % 2 == 0 ? first : second;
        }
      }
    }
    return read_labels(image_of(map, "freesurfer"), {.by_class = true, .joined = {}}).notes;
  };
  EXPECT_TRUE(notes_of(16, 2, 3).empty()) << "merged";
  EXPECT_TRUE(notes_of(16, 41, 2012).empty()) << "merged";
  EXPECT_TRUE(notes_of(16, 5001, 5002).empty()) << "white matter of either side";
  const auto missing = notes_of(8, 2, 1012);
  ASSERT_EQ(missing.size(), 1U);
  expect_parts(missing.front(), {"warning", "right hemisphere"});
  expect_parts(notes_of(8, 42, 5002).front(), {"warning", "left hemisphere"});
}

TEST_F(SceneLabels, AMapWithoutVentriclesIsReadAndSaidSo) {
  LabelMap map = block_labels();
  map.voxels.assign(64, 2);
  std::fill_n(map.voxels.begin(), 32, std::uint16_t{41});
  const auto read = read_labels(image_of(map, "freesurfer"), {.by_class = true, .joined = {}});
  ASSERT_EQ(read.notes.size(), 1U);
  expect_parts(read.notes[0], {"no ventricles"});
}

TEST_F(SceneLabels, WithoutFluidAndSkullTheOtherLabelsStayForTheSkullToBeTakenFrom) {
  LabelMap map = freesurfer_labels();
  std::replace(map.voxels.begin(), map.voxels.end(), std::uint16_t{24}, std::uint16_t{0});
  const auto read = read_labels(image_of(map, "freesurfer"), {.by_class = true, .joined = {}});
  EXPECT_EQ(read.map.voxels, (std::vector<std::uint16_t>{1, 1, 2, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 1, 1, 2, 6, 6, 0, 0}));
}

TEST_F(SceneLabels, NumbersThatATissueListsAreJoined) {
  const Scene scene = parse("<scene><tissues><tissue labels=\"3 6\"/><tissue label=\"1\"/></tissues></scene>");
  const LabelReading reading = label_reading(scene);
  EXPECT_FALSE(reading.by_class);
  const auto read = read_labels(image_of(block_labels()), reading);
  EXPECT_EQ(read.map.at(1, 2, 1), 3);
  EXPECT_EQ(read.map.at(1, 1, 1), 1);
  EXPECT_TRUE(read.notes.empty());
}

TEST_F(SceneLabels, NumbersThatNoTissueListsAreToldAndWarnedOfWithinTheBrain) {
  LabelMap map;
  map.geometry.size = {5, 5, 5};
  map.geometry.spacing.setConstant(10);
  map.voxels.assign(125, 1);
  map.at(2, 2, 3) = 7;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) {
      map.at(i, j, 0) = 0;
      map.at(i, j, 1) = 9;
    }
  }
  const Scene scene = parse("<scene><tissues><tissue labels=\"1 2\"/></tissues></scene>");
  const auto read = read_labels(image_of(map), label_reading(scene));
  ASSERT_EQ(read.notes.size(), 2U);
  expect_parts(read.notes[0], {"labels.nii.gz", "not brain", "no tissue lists them", "9 (25 ml), 7 (1 ml)"});
  expect_parts(read.notes[1], {"warning", "label 7 (1 ml)", "within the brain", "other_labels"});
}

TEST_F(SceneLabels, ANumberThatTheTableLacksIsNotSaidToBeNoBrainWhereTheBrainEnclosesIt) {
  LabelMap map;
  map.geometry.size = {7, 7, 7};
  map.geometry.spacing.setConstant(10);
  for (int i = 0; i < 343; ++i) {
    map.voxels.push_back(i % 2 == 0 ? 2 : 41);
  }
  map.at(3, 3, 3) = 99;
  map.at(0, 3, 3) = 0;
  map.at(1, 3, 3) = 507;
  map.at(5, 5, 5) = 4;
  const auto notes = read_labels(image_of(map, "freesurfer"), {.by_class = true, .joined = {}}).notes;
  ASSERT_EQ(notes.size(), 2U);
  expect_parts(notes[0],
               {"warning", "label 99 (1 ml)", "within the brain", "not among FreeSurfer's", "tissue about it"});
  expect_parts(notes[1], {"not brain where the brain does not enclose them", "FreeSurfer's: 507 (1 ml)"});
  map.geometry.spacing.setConstant(5);
  const auto of_few = read_labels(image_of(map, "freesurfer"), {.by_class = true, .joined = {}}).notes;
  ASSERT_EQ(of_few.size(), 1U) << "any head has a few voxels so";
  expect_parts(of_few[0], {"99 (0.1 ml)", "507 (0.1 ml)"});
}

}  // namespace brainshift::pipelines::scene_labels_test
