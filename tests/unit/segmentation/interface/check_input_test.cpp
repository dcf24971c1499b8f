// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/segment.hpp"

#include <gtest/gtest.h>

#include <limits>
#include "tests/unit/segmentation/builders.hpp"
#include "tests/unit/segmentation/drawn_head.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::test::check_input_test {

using namespace drawn_head;
using namespace segmentation;

TEST(Segment, InputThatDoesNotFitIsRefusedInASentence) {
  const Head drawn = head(oblique());
  SegmentInput shifted;
  shifted.t1 = drawn.t1;
  shifted.labels = drawn.labels;
  shifted.labels->geometry.origin.z() += 1.0;
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { segment(shifted, two_labels()); }, {"different grids", "T1"}));

  SegmentInput lacking;
  lacking.labels = drawn.mask;
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { segment(lacking, two_labels()); }, {"label 2"}));

  SegmentInput empty;
  empty.t1 = drawn.t1;
  empty.brain_mask = drawn.mask;
  std::fill(empty.brain_mask->voxels.begin(), empty.brain_mask->voxels.end(), std::uint16_t{0});
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { segment(empty, two_labels()); }, {"empty"}));

  SegmentInput cut = empty;
  cut.brain_mask = ball(drawn.mask.geometry, centre + Eigen::Vector3d(0.0, 0.0, 34.0), brain_radius);
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { segment(cut, two_labels()); }, {"border", "inside out"}));

  SegmentInput broken;
  broken.t1 = drawn.t1;
  broken.brain_mask = drawn.mask;
  broken.t1->at(36, 36, 36) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { segment(broken, two_labels()); }, {"finite"}));

  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { segment({}, two_labels()); }, {"give labels"}));
  SegmentOptions bad = two_labels();
  bad.edge_length = std::nan("");
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { segment(lacking, bad); },
                                                   {"edge_length is 'nan', but must be a number >= 0.5 (mm)"}));
}

TEST(Segment, RefusesABrainWhoseLengthsAreInMetres) {
  SegmentInput input;
  const auto grid =
      grid_around(Eigen::Vector3d::Zero(), 40, Eigen::Vector3d::Constant(0.004), Eigen::Matrix3d::Identity());
  input.labels = ball(grid, Eigen::Vector3d::Zero(), 0.07);
  SegmentOptions options;
  options.brain_labels = {1};
  try {
    segment(input, options);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("metres"), std::string::npos) << error.what();
  }
}

TEST(Segment, RefusesEdgesTooLongForTheBrain) {
  const Head drawn = head(oblique());
  SegmentOptions options = two_labels();
  SegmentInput labels, masked, surface;
  labels.labels = drawn.labels;
  masked.t1 = drawn.t1;
  masked.brain_mask = drawn.mask;
  surface.surface = sphere(centre, brain_radius, 3);
  options.edge_length = 12;
  for (const SegmentInput& input : {labels, masked, surface}) {
    EXPECT_TRUE(throws_saying<std::invalid_argument>(
        [&] { segment(input, options); }, {"edge_length is '12'", "at most ", " (mm) for a brain ", " mm across"}));
  }
  options.edge_length = 9;
  EXPECT_GT(segment(surface, options).brain.triangles.rows(), 0);
}

TEST(Segment, TakesTheDefaultEdgeForTheSmallestBrain) {
  SegmentInput input;
  const Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  input.labels = ball(grid_around(middle, 32, Eigen::Vector3d::Ones(), oblique()), middle, 10.6);
  SegmentOptions options;
  options.brain_labels = {1};
  EXPECT_GT(segment(input, options).brain.triangles.rows(), 0);
  options.edge_length = 5.1;
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { segment(input, options); }, {"at most 5 (mm)"}));
}

}  // namespace brainshift::test::check_input_test
