// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/labels/segmentation_file.hpp"

#include <gtest/gtest.h>

#include "tests/unit/expect_parts.hpp"
#include "tests/unit/segmentation/builders.hpp"
#include "tests/unit/segmentation/slicer_file.hpp"

namespace brainshift::test::segmentation_file_test {

using namespace segmentation;
using Row = std::vector<std::uint16_t>;

class SegmentationFile : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& keys, const std::vector<Row>& layers) const {
    return write_slicer_file(folder_ / "a.seg.nrrd", keys, layers);
  }
  ScratchFolder folder_;
};

// A tumour drawn before the brain, a filled head drawn after it, ventricles within the brain.
TEST_F(SegmentationFile, TheMoreSpecificLiesOverWhatItIsInWhicheverCameFirst) {
  const auto file = write(slicer_segment(0, "Tumor", 1, 0) + slicer_segment(1, "Brain", 1, 1) +
                              slicer_segment(2, "Head", 1, 2) + slicer_segment(3, "Lateral ventricles", 2, 0),
                          {{0, 0, 0, 1, 2, 1}, {0, 0, 1, 1, 1, 0}, {0, 1, 1, 1, 1, 1}});
  const Overlaid read = read_by_names(file);
  EXPECT_EQ(read.map.voxels, (Row{0, 0, 1, 3, 2, 3}));
  ASSERT_EQ(read.notes.size(), 2U);
  expect_parts(read.notes[0], {"a.seg.nrrd",
                               "tumour (Tumor), ventricles (Lateral ventricles), parenchyma (Brain), not "
                               "brain (Head)"});
  expect_parts(read.notes[1], {"'Tumor' lies over 'Brain' in 10 ml", "'Tumor' lies over 'Head' in 20 ml",
                               "'Brain' lies over 'Head' in 10 ml"});
}

TEST_F(SegmentationFile, OfOneClassTheLaterLiesOver) {
  const auto file =
      write(slicer_segment(0, "Cortex", 5, 1) + slicer_segment(1, "White matter", 6, 0), {{6, 6, 0}, {0, 5, 5}});
  EXPECT_EQ(read_by_numbers(file).map.voxels, (Row{6, 6, 5}));
  EXPECT_EQ(read_by_names(file).map.voxels, (Row{1, 1, 1}));
}

TEST_F(SegmentationFile, OneLayerIsReadAsItIsByItsNumbers) {
  const auto file = write(slicer_segment(0, "Brain", 2, 0), {{2, 9, 0}});
  EXPECT_EQ(read_by_numbers(file).map.voxels, (Row{2, 9, 0}));
  const Overlaid read = read_by_names(file);
  EXPECT_EQ(read.map.voxels, (Row{1, 0, 0}));
  ASSERT_EQ(read.notes.size(), 2U);
  expect_parts(read.notes[1], {"no segment has the number 9", "10 ml"});
}

TEST_F(SegmentationFile, NumbersThatMeanTwoThingsAreRefused) {
  const auto file = write(slicer_segment(0, "Brain", 1, 0) + slicer_segment(1, "Tumour", 1, 1), {{1, 1}, {0, 1}});
  expect_parts(refusal([&] { read_by_numbers(file); }), {"a.seg.nrrd", "'Brain' and 'Tumour'", "the number 1"});
  EXPECT_EQ(read_by_names(file).map.voxels, (Row{1, 3}));
}

TEST(NamesTell, WhereEachSegmentIsNamed) {
  EXPECT_TRUE(names_tell(std::vector<Segment>{{.name = "Brain"}, {.name = "mass"}}));
  EXPECT_FALSE(names_tell(std::vector<Segment>{{.name = "Brain"}, {.name = "Segment_2"}}));
  EXPECT_FALSE(names_tell(std::vector<Segment>{{.name = "1"}}));
  EXPECT_FALSE(names_tell({}));
}

}  // namespace brainshift::test::segmentation_file_test
