// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/labels/label_fit.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/segmentation/builders.hpp"
#include "tests/unit/segmentation/drawn_head.hpp"

namespace brainshift::test::label_fit_test {

using namespace drawn_head;
using segmentation::label_fit;

const std::vector<std::uint16_t> brain = {1, 2};

TEST(LabelFit, IsHighInAHeadsOwnT1AndOneInThatOfAnother) {
  const Head own = head(oblique_left_handed());
  EXPECT_GT(label_fit(own.t1, own.labels, brain), 2.0);
  const LabelMap other = ball(own.labels.geometry, centre + Eigen::Vector3d(7, 5, -4), 24);
  EXPECT_LT(label_fit(own.t1, other, brain), 1.1);
}

TEST(LabelFit, DoesNotAskWhichSideIsBright) {
  Head own = head(oblique());
  for (float& value : own.t1.voxels) {
    value = -value;
  }
  EXPECT_GT(label_fit(own.t1, own.labels, brain), 2.0);
}

TEST(LabelFit, OfNoiseIsOne) {
  Head own = head(oblique());
  std::mt19937 generator(3);
  std::normal_distribution<float> noise(100.0F, 20.0F);
  for (float& value : own.t1.voxels) {
    value = noise(generator);
  }
  EXPECT_NEAR(label_fit(own.t1, own.labels, brain).value(), 1.0, 0.05);
}

TEST(LabelFit, IsNotToldWhereThereIsNothingToCompare) {
  Head own = head(oblique());
  EXPECT_FALSE(label_fit(own.t1, own.labels, std::vector<std::uint16_t>{9}));
  EXPECT_FALSE(label_fit(own.t1, ball(own.labels.geometry, centre, 3), brain)) << "too short a boundary";
  std::fill(own.t1.voxels.begin(), own.t1.voxels.end(), 5.0F);
  EXPECT_FALSE(label_fit(own.t1, own.labels, brain)) << "no contrast";
}

}  // namespace brainshift::test::label_fit_test
