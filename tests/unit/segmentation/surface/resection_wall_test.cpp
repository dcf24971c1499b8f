// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/surface/resection_wall.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::segmentation::resection_wall_test {

constexpr std::array<std::uint16_t, 2> brain = {1, 3};
constexpr std::array<std::uint16_t, 1> tumour = {3};
constexpr double radius = 30;

/// A brain in an oblique image of 1.5 mm voxels, with a tumour in it.
LabelMap head(const Eigen::Vector3d& middle, double size) {
  LabelMap labels;
  labels.geometry.size.setConstant(48);
  labels.geometry.spacing.setConstant(1.5);
  labels.geometry.direction << 0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1;
  labels.geometry.origin = -labels.geometry.direction * Eigen::Vector3d::Constant(1.5 * 47 / 2);
  for (std::size_t v = 0; v < labels.geometry.voxel_count(); ++v) {
    const Eigen::Vector3d x = labels.geometry.to_world(
        {static_cast<double>(v % 48), static_cast<double>(v / 48 % 48), static_cast<double>(v / 2304)});
    labels.voxels.push_back(x.norm() > radius ? 0 : (x - middle).norm() < size ? 3 : 1);
  }
  return labels;
}

TEST(ResectionWall, OfABallIsThatBall) {
  const Eigen::Vector3d middle(5, -8, 3);
  const MeasuredSurface wall = resection_wall(head(middle, 12), brain, tumour, 5);
  EXPECT_TRUE(wall.measures.is_sound());
  EXPECT_NEAR(volume(wall.surface), 4 * std::numbers::pi / 3 * std::pow(12, 3), 0.02 * 7238);
  for (const auto& vertex : wall.surface.vertices.rowwise()) {
    EXPECT_NEAR((vertex.transpose() - middle).norm(), 12, 0.8);
  }
}

TEST(ResectionWall, CrossesTheBrainsSurface) {
  const Eigen::Vector3d middle(0, 0, 26);
  const MeasuredSurface wall = resection_wall(head(middle, 12), brain, tumour, 5);
  EXPECT_TRUE(wall.measures.is_sound());
  double farthest = 0;
  std::size_t beside = 0;
  for (const auto& vertex : wall.surface.vertices.rowwise()) {
    farthest = std::max(farthest, vertex.norm());
    const double in_middle = std::hypot(vertex[0], vertex[1]);
    beside += in_middle < 5 && vertex[2] > 0 && std::abs(vertex.norm() - radius) < 1.5 ? 1 : 0;
  }
  EXPECT_GT(farthest, radius + 2.5);
  EXPECT_EQ(beside, 0U) << "it runs along the brain's surface";
}

/// Slices of 5 mm with voxels of 1 mm: beyond the brain the wall goes on for a few millimetres along each axis.
TEST(ResectionWall, OfThickSlicesEndsAFewMillimetresOutside) {
  LabelMap labels;
  labels.geometry.size = {64, 64, 16};
  labels.geometry.spacing = {1, 1, 5};
  labels.geometry.origin = {-31.5, -31.5, -37.5};
  for (int k = 0; k < 16; ++k) {
    for (int j = 0; j < 64; ++j) {
      for (int i = 0; i < 64; ++i) {
        const Eigen::Vector3d x = labels.geometry.to_world(Eigen::Vector3d(i, j, k));
        labels.voxels.push_back(x.norm() > 25 ? 0 : (x - Eigen::Vector3d(0, 0, 22)).norm() < 10 ? 3 : 1);
      }
    }
  }
  const MeasuredSurface wall = resection_wall(labels, brain, tumour, 3);
  EXPECT_TRUE(wall.measures.is_sound());
  const double farthest = wall.surface.vertices.rowwise().norm().maxCoeff();
  EXPECT_GT(farthest, 25 + 2);
  EXPECT_LT(farthest, 25 + 14);
}

TEST(ResectionWall, NeedsAVoxel) {
  const LabelMap none = head({100, 0, 0}, 5);
  EXPECT_NE(test::refusal([&] { resection_wall(none, brain, tumour, 5); }).find("label 3, which no voxel"),
            std::string::npos);
}

}  // namespace brainshift::segmentation::resection_wall_test
