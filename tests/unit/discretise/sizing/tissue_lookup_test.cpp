// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/sizing/tissue_lookup.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "tests/unit/discretise/bodies.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::discretise::tissue_lookup_test {

using Eigen::Vector3d;

constexpr std::array<std::int32_t, 2> brain = {1, 3};
const Vector3d centre(30, -20, 10);

/// A row of voxels along x with these labels, the first at the origin.
LabelMap row_of(const std::vector<std::uint16_t>& labels) {
  LabelMap map;
  map.geometry.size = {static_cast<int>(labels.size()), 1, 1};
  map.geometry.spacing = {2, 1, 1};
  map.voxels = labels;
  return map;
}

TEST(TissueLookup, WithoutLabelsEverythingIsBrainOfTissueOne) {
  const TissueLookup tissue(nullptr, brain);
  EXPECT_EQ(tissue.tissue_at({1e4, 0, 0}), 1);
  EXPECT_TRUE(tissue.in_brain({1e4, 0, 0}));
}

TEST(TissueLookup, GivesTheVoxelsLabelOrThatOfTheNearestBrainVoxel) {
  const LabelMap labels = row_of({0, 5, 1, 1, 3, 4, 0});
  const TissueLookup tissue(&labels, brain);
  const auto at = [&](double x) { return tissue.tissue_at({x, 0, 0}); };
  EXPECT_EQ(at(4), 1);
  EXPECT_EQ(at(8.9), 3);
  EXPECT_EQ(at(2), 1) << "label 5 is not of the brain";
  EXPECT_EQ(at(10), 3);
  EXPECT_EQ(at(-500), 1) << "outside the image";
  EXPECT_EQ(at(500), 3);
  EXPECT_TRUE(tissue.in_brain({4, 0, 0}));
  EXPECT_FALSE(tissue.in_brain({2, 0, 0}));
  EXPECT_FALSE(tissue.in_brain({500, 0, 0}));
}

TEST(TissueLookup, FindsTheNearestBrainVoxelFromAnywhereInAnObliqueImage) {
  const LabelMap labels = test::ball_labels(centre, 4, 9);
  constexpr std::array<std::int32_t, 1> rind = {1};  // the ball of tissue 3 in it is a hole
  const TissueLookup tissue(&labels, rind);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> within(-14, 14);
  for (int i = 0; i < 200; ++i) {
    const Vector3d x = centre + Vector3d(within(random), within(random), within(random));
    EXPECT_EQ(tissue.tissue_at(x), 1);
    EXPECT_EQ(tissue.in_brain(x), label_at(labels, x) == 1);
  }
}

TEST(TissueLookup, OfAnImageWithoutBrainIsRefused) {
  const LabelMap labels = row_of({0, 5, 6});
  EXPECT_NE(test::refusal([&] { TissueLookup(&labels, brain); }).find("no voxel with a brain label"),
            std::string::npos);
}

TEST(LabelVoxels, AreTheCentresOfAllVoxelsOfTheLabel) {
  const LabelMap labels = test::ball_labels(centre, 5.2, 9);
  const Points voxels = label_voxels(labels, 3);
  EXPECT_EQ(voxels.rows(), std::count(labels.voxels.begin(), labels.voxels.end(), 3));
  EXPECT_LT((voxels.rowwise() - centre.transpose()).rowwise().norm().maxCoeff(), 5.2);
  EXPECT_LT((voxels.colwise().mean() - centre.transpose()).norm(), 1e-9);
  EXPECT_EQ(label_voxels(labels, 4).rows(), 0);
}

TEST(TissueBoundary, LiesMidwayBetweenVoxelsOfDifferentBrainTissues) {
  const Points faces = tissue_boundary(row_of({1, 1, 3, 0, 1, 5, 3}), brain);
  ASSERT_EQ(faces.rows(), 1) << "1|3; what is not of the brain has no boundary";
  EXPECT_EQ(faces.row(0), Eigen::RowVector3d(3, 0, 0));
}

TEST(TissueBoundary, OfABallInABallIsTheInnerSphere) {
  const LabelMap labels = test::ball_labels(centre, 5, 9);
  const Points faces = tissue_boundary(labels, brain);
  const Eigen::VectorXd radii = (faces.rowwise() - centre.transpose()).rowwise().norm();
  EXPECT_GT(radii.minCoeff(), 4.4);
  EXPECT_LT(radii.maxCoeff(), 5.6);
}

}  // namespace brainshift::discretise::tissue_lookup_test
