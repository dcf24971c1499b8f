// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/segments.hpp"

#include <gtest/gtest.h>

#include "tests/unit/segmentation/builders.hpp"
#include "tests/unit/segmentation/slicer_file.hpp"

namespace brainshift::test::segments_test {

const std::vector<std::vector<std::uint16_t>> two_layers = {{0, 1, 1, 7}, {2, 0, 60000, 0}};

TEST(Segments, HaveTheNamesNumbersAndLayersOfTheHeader) {
  const ScratchFolder folder;
  const auto file = write_slicer_file(
      folder / "a.seg.nrrd", slicer_segment(0, "Brain", 1, 0) + slicer_segment(1, "Tumör: left", 60000, 1), two_layers);
  const auto segments = read_segments(file);
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segments[0].name, "Brain");
  EXPECT_EQ(segments[1].name, "Tumör: left");
  EXPECT_EQ(segments[1].label, 60000);
  EXPECT_EQ(segments[1].layer, 1U);
}

TEST(Segments, LayersAreReadWholeAndInTheirPlace) {
  const ScratchFolder folder;
  const auto layers = read_layers(write_slicer_file(folder / "a.seg.nrrd", slicer_segment(0, "a", 1, 0), two_layers));
  ASSERT_EQ(layers.size(), 2U);
  for (std::size_t layer = 0; layer < 2; ++layer) {
    EXPECT_EQ(layers[layer].voxels, two_layers[layer]);
    EXPECT_EQ(layers[layer].geometry.spacing, Eigen::Vector3d(10, 10, 100));
    EXPECT_EQ(layers[layer].geometry.origin, Eigen::Vector3d(1, 2, 3));
  }
  const auto one = read_layers(write_slicer_file(folder / "b.seg.nrrd", slicer_segment(0, "a", 1, 0), {{3, 4}}));
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one.front().voxels, (std::vector<std::uint16_t>{3, 4}));
}

// As 3D Slicer wrote before it had layers.
TEST(Segments, WithoutNumbersHaveALayerEachThatHoldsOne) {
  const ScratchFolder folder;
  const auto segments =
      read_segments(write_slicer_file(folder / "a.seg.nrrd", "Segment0_Name:=a\nSegment1_Name:=b\n", two_layers));
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segments[1].layer, 1U);
  EXPECT_EQ(segments[1].label, 1);
}

TEST(Segments, AreNoneInOtherFiles) {
  const ScratchFolder folder;
  EXPECT_TRUE(read_segments(write_slicer_file(folder / "a.nrrd", "conversion:=none\n", {{1}})).empty());
  EXPECT_TRUE(read_segments(folder / "none.nii.gz").empty());
}

TEST(Segments, ThatCannotBeAreRefusedWithASentence) {
  const ScratchFolder folder;
  const auto fault = [&](const std::string& keys) {
    return refusal([&] { read_segments(write_slicer_file(folder / "a.seg.nrrd", keys, two_layers)); });
  };
  const auto says = [](const std::string& sentence, const std::string& words) {
    return sentence.find("a.seg.nrrd: ") != std::string::npos && sentence.find(words) != std::string::npos;
  };
  EXPECT_TRUE(says(fault(slicer_segment(0, "Brain", 1, 2)), "'Brain' lies in layer 2")) << fault("");
  EXPECT_TRUE(says(fault(slicer_segment(0, "Brain", 70000, 0)), "Segment0_LabelValue is '70000'"));
  EXPECT_TRUE(says(fault(slicer_segment(0, "Brain", -1, 0)), "Segment0_LabelValue is '-1'"));
  EXPECT_TRUE(says(fault(slicer_segment(0, "a", 1, 0) + "Segmentation_SourceRepresentation:=Fractional labelmap\n"),
                   "fractional"));
}

}  // namespace brainshift::test::segments_test
