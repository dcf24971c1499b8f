// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/discretise_warnings.hpp"

#include <gtest/gtest.h>

#include "tests/unit/pipelines/runner/expect_one.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::pipelines::discretise_warnings_test {

/// A ball of 1 about the origin with one of 3 in it, 2 mm a voxel.
LabelMap drawn() {
  LabelMap labels;
  labels.geometry.size.setConstant(40);
  labels.geometry.spacing.setConstant(2);
  labels.geometry.origin.setConstant(-39);
  labels.voxels.resize(labels.geometry.voxel_count());
  for (int k = 0; k < 40; ++k) {
    for (int j = 0; j < 40; ++j) {
      for (int i = 0; i < 40; ++i) {
        const double r = labels.geometry.to_world(Eigen::Vector3d(i, j, k)).norm();
        labels.at(i, j, k) = r < 8 ? 3 : r < 30 ? 1 : 0;
      }
    }
  }
  return labels;
}

TEST(DiscretiseWarnings, TellOfABodyBesideItsLabels) {
  const Surface brain = test::sphere({0, 0, 0}, 30, 3);
  LabelMap labels = drawn();
  EXPECT_TRUE(warnings_of(brain, labels, {}).empty());
  labels.geometry.origin.x() += 2;
  EXPECT_TRUE(warnings_of(brain, labels, {}).empty());
  labels.geometry.origin.y() += 4;
  expect_one(warnings_of(brain, labels, {}), {"4.5 mm away", "frame"});
  discretise::DiscretiseOptions in_part;
  in_part.brain_labels = {3};
  EXPECT_TRUE(warnings_of(brain, labels, in_part).empty()) << "of which the rest is no tissue";
}

TEST(DiscretiseWarnings, TellOfFinerNodesAtATumourThatIsNotThere) {
  const Surface brain = test::sphere({0, 0, 0}, 30, 3);
  discretise::DiscretiseOptions options;
  options.tumour_factor = 0.5;
  EXPECT_TRUE(warnings_of(brain, drawn(), options).empty());
  options.tumour_label = 7;
  expect_one(warnings_of(brain, drawn(), options), {"finer at a tumour", "label 7", "tumour_label"});
}

}  // namespace brainshift::pipelines::discretise_warnings_test
