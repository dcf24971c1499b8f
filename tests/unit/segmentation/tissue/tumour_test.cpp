// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/tissue/tumour.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "segmentation/interface/options.hpp"
#include "segmentation/segment.hpp"
#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::tumour_test {

using namespace segmentation;

const ImageGeometry grid = grid_around(Eigen::Vector3d::Zero(), 40, {2, 2, 2}, Eigen::Matrix3d::Identity());
const LabelMap brain = ball(grid, Eigen::Vector3d::Zero(), 25);

LabelMap tumour_at(double x) {
  return ball(grid, {x, 0, 0}, 6);
}

SegmentInput with_tumour_at(double x) {
  SegmentInput input;
  input.labels = brain;
  input.tumour_mask = tumour_at(x);
  return input;
}

SegmentOptions of_brain_and_tumour() {
  SegmentOptions options;
  options.brain_labels = {default_label::parenchyma, default_label::tumour};
  return options;
}

TEST(Tumour, InsideTheBrainIsNothingToSay) {
  EXPECT_EQ(outside_body(tumour_at(10), mask_of(brain)), "");
}

TEST(Tumour, PartlyOutsideIsToldWithItsVolume) {
  const std::string said = outside_body(tumour_at(24), mask_of(brain));
  EXPECT_EQ(said.find("warning: "), 0U);
  EXPECT_NE(said.find("0.5 ml of the tumour mask's 1.1 ml"), std::string::npos) << said;
}

TEST(Tumour, OffTheBrainIsTold) {
  const Segmentation result = segment(with_tumour_at(-33), of_brain_and_tumour());
  EXPECT_TRUE(std::ranges::any_of(result.notes, [](const std::string& note) {
    return note.starts_with("warning: 0.9 ml of the tumour mask's 0.9 ml");
  }));
}

TEST(Tumour, OfWhichTheLabelIsNoBrainIsRefused) {
  SegmentOptions options = of_brain_and_tumour();
  options.brain_labels.pop_back();
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { segment(with_tumour_at(10), options); }, {"label, 3"}));
}

TEST(Tumour, GetsItsLabelInTheBodyAlone) {
  LabelMap labels = brain;
  const LabelMap tumour = tumour_at(24);
  add_tumour(labels, in_body(tumour, mask_of(brain)));
  for (std::size_t i = 0; i < labels.voxels.size(); ++i) {
    const bool both = tumour.voxels[i] != 0 && brain.voxels[i] != 0;
    EXPECT_EQ(labels.voxels[i], both ? default_label::tumour : brain.voxels[i]);
  }
}

}  // namespace brainshift::test::tumour_test
