// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/body/brain_body.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::brain_body_test {

using namespace segmentation;

const Eigen::Vector3d middle(5, 6, 7);
const ImageGeometry grid = grid_around(middle, 80, Eigen::Vector3d::Ones(), oblique_left_handed());

// A ball of 25 mm with a slit of 4 mm down to its middle.
LabelMap slit_ball() {
  return image_by<std::uint16_t>(grid, [](const Eigen::Vector3d& world) {
    const Eigen::Vector3d x = world - middle;
    const bool slit = std::abs(x.x()) <= 2 && x.z() > 0;
    return static_cast<std::uint16_t>(x.norm() <= 25 && !slit ? 1 : 0);
  });
}

TEST(BrainBody, SulciAreClosedAndNothingElseIsAdded) {
  const Mask tissue = mask_of(slit_ball());
  const Mask whole = mask_of(ball(grid, middle, 25));
  EXPECT_EQ(brain_body(tissue, 0).mask.voxels, tissue.voxels);
  const Mask closed_body = brain_body(tissue, 4).mask;
  std::size_t outside = 0;
  for (std::size_t i = 0; i < whole.voxels.size(); ++i) {
    outside += closed_body.voxels[i] > whole.voxels[i] ? 1 : 0;
  }
  EXPECT_LT(outside, count(whole) / 200);
  EXPECT_GT(count(closed_body), count(tissue) + (count(whole) - count(tissue)) * 8 / 10);
}

TEST(BrainBody, LoosePiecesAreDroppedAndTheirVolumeToldExceptOnesThatClosingJoins) {
  Mask tissue = mask_of(ball(grid, middle, 20));
  const auto put = [&](const Eigen::Vector3d& away) {
    const Eigen::Array3i at = grid.to_index(middle + away).array().round().cast<int>();
    tissue.at(at.x(), at.y(), at.z()) = 1;
  };
  put({30, 0, 0});
  put({0, 30, 0});
  put({0, 0, 22});
  const BrainBody open = brain_body(tissue, 0);
  EXPECT_EQ(open.loose_pieces, 3U);
  EXPECT_NEAR(open.loose_volume, 3, 1e-9);
  const BrainBody shut = brain_body(tissue, 4);
  EXPECT_EQ(shut.loose_pieces, 2U);
}

TEST(BrainBody, WhatTheFieldOfViewCutsOffIsMeasuredAndRefusedWhereItIsMuch) {
  EXPECT_EQ(brain_body(mask_of(ball(grid, middle, 25)), 0).cut.area, 0);
  // The grid's first layer cuts the ball 20 mm from its middle: a disc of radius 15 mm.
  const Eigen::Vector3d place = grid.to_world(Eigen::Vector3d(20, 40, 40));
  EXPECT_NEAR(brain_body(mask_of(ball(grid, place, 25)), 0).cut.area, 225 * std::numbers::pi, 20);
  Mask outside = mask_of(ball(grid, middle, 25));
  for (std::uint8_t& voxel : outside.voxels) {
    voxel = voxel == 0 ? 1 : 0;
  }
  EXPECT_THROW(brain_body(outside, 0), std::invalid_argument);
}

// Tissue within 20 mm, fluid to 26 mm and in a canal downward.
LabelMap in_fluid() {
  return image_by<std::uint16_t>(grid, [](const Eigen::Vector3d& world) {
    const Eigen::Vector3d x = world - middle;
    const bool canal = x.head<2>().norm() <= 3 && x.z() < -20;
    return static_cast<std::uint16_t>(x.norm() <= 20 ? 1 : x.norm() <= 26 || canal ? 4 : 0);
  });
}

/// Cropped to its bounding box a brain touches every face of the border, and nothing of it is missing.
TEST(BrainBody, ABrainThatTouchesTheBorderIsNotSaidToBeCutOff) {
  Mask whole = cropped(mask_of(ball(grid, middle, 30)), 0);
  const BorderCut touches = border_cut(whole);
  EXPECT_GT(touches.area, 0);
  EXPECT_FALSE(touches.off);
  const std::string said = cut_sentence(touches, "the image's border");
  EXPECT_EQ(said.find("warning"), std::string::npos) << said;
  EXPECT_NE(said.find("touches the brain over"), std::string::npos) << said;
  // Without the outermost 3 mm on one side.
  whole.geometry.size.z() -= 3;
  whole.voxels.resize(whole.geometry.voxel_count());
  const BorderCut cut = border_cut(whole);
  EXPECT_TRUE(cut.off);
  EXPECT_NE(cut_sentence(cut, "the image's border").find("warning: the image's border cuts the brain off over"),
            std::string::npos);
  EXPECT_EQ(cut_sentence({}, "the image's border"), "");
}

TEST(FluidSpace, ReachesToTheFluidsOuterBoundaryAndNotDownTheSpine) {
  const LabelMap labels = in_fluid();
  const Mask brain = mask_of(ball(grid, middle, 20));
  const Mask space = fluid_space(labels, 4, brain, 10);
  const double ball_of_26 = static_cast<double>(count(mask_of(ball(grid, middle, 26))));
  EXPECT_NEAR(static_cast<double>(count(space)), ball_of_26, 0.01 * ball_of_26);
  EXPECT_FALSE(touches_border(space));
}

TEST(FluidSpace, IsEmptyWhereLittleFluidTouchesTheBrain) {
  const Mask brain = mask_of(ball(grid, middle, 20));
  LabelMap labels = ball(grid, middle, 20);
  labels.at(60, 40, 40) = 4;
  EXPECT_TRUE(fluid_space(labels, 4, brain, 10).voxels.empty());
}

// A brain of 20 mm within a shell from `inner` mm on, open where x.z() is below `open`.
LabelMap in_shell(double inner, double open) {
  return image_by<std::uint16_t>(grid, [&](const Eigen::Vector3d& world) {
    const Eigen::Vector3d x = world - middle;
    return static_cast<std::uint16_t>(x.norm() <= 20 ? 1 : x.norm() > inner && x.z() > open ? 6 : 0);
  });
}

TEST(BoundedSpace, ReachesToTheLabelEvenWhereThatHasAGap) {
  const Mask brain = mask_of(ball(grid, middle, 20));
  const double ball_of_24 = static_cast<double>(count(mask_of(ball(grid, middle, 24))));
  for (const double open : {-100.0, -21.0}) {
    const Mask space = bounded_space(in_shell(24, open), 6, brain, 10);
    ASSERT_FALSE(space.voxels.empty()) << open;
    EXPECT_NEAR(static_cast<double>(count(space)), ball_of_24, 0.15 * ball_of_24) << open;
    EXPECT_FALSE(touches_border(space));
  }
}

TEST(BoundedSpace, IsEmptyWhereTheLabelIsFarOffOrHalfOpen) {
  const Mask brain = mask_of(ball(grid, middle, 20));
  EXPECT_TRUE(bounded_space(in_shell(32, -100), 6, brain, 10).voxels.empty());
  EXPECT_TRUE(bounded_space(in_shell(24, 0), 6, brain, 10).voxels.empty());
}

TEST(SkullCavity, MustEncloseTheBrain) {
  const Mask brain = mask_of(ball(grid, middle, 20));
  LabelMap labels = image_by<std::uint16_t>(grid, [](const Eigen::Vector3d& world) {
    const double r = (world - middle).norm();
    return static_cast<std::uint16_t>(r <= 20 ? 1 : r > 26 && r <= 29 ? 5 : 0);
  });
  EXPECT_TRUE(encloses(labels, 5, brain));
  const double ball_of_26 = static_cast<double>(count(mask_of(ball(grid, middle, 26))));
  EXPECT_EQ(static_cast<double>(count(skull_cavity(labels, 5, brain))), ball_of_26);
  for (std::uint16_t& voxel : labels.voxels) {
    voxel = voxel == 5 && &voxel - labels.voxels.data() < 256000 ? std::uint16_t{0} : voxel;
  }
  EXPECT_FALSE(encloses(labels, 5, brain));
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { skull_cavity(labels, 5, brain); }, {"does not enclose"}));
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { skull_cavity(labels, 9, brain); }, {"label 9", "no voxel"}));
}

}  // namespace brainshift::test::brain_body_test
