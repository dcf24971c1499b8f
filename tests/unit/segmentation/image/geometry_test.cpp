// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/image.hpp"

#include "segmentation/image/itk_bridge.hpp"
#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::geometry_test {

const Eigen::Vector3d far_away(120.0, -80.0, 300.0);

TEST(ImageGeometry, WorldAndIndexAgreeWithItkInALeftHandedObliqueFrame) {
  const auto geometry = grid_around(far_away, 9, {0.9, 1.1, 2.5}, oblique_left_handed());
  const ScalarImage image{geometry, std::vector<float>(geometry.voxel_count())};
  const auto itk_image = seen_by_itk(image);
  itk::ContinuousIndex<double, 3> index;
  index[0] = 1.25;
  index[1] = 7.5;
  index[2] = 3.0;
  itk::Point<double, 3> expected;
  itk_image->TransformContinuousIndexToPhysicalPoint(index, expected);
  const Eigen::Vector3d world = geometry.to_world({1.25, 7.5, 3.0});
  for (unsigned axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(world[axis], expected[axis], 1e-10);
  }
  EXPECT_TRUE(geometry.to_index(world).isApprox(Eigen::Vector3d(1.25, 7.5, 3.0), 1e-12));
}

TEST(ImageGeometry, TheItkBridgeKeepsVoxelsAndPlace) {
  const auto geometry = grid_around(far_away, 4, {1.0, 2.0, 3.0}, oblique_left_handed());
  VectorImage image{geometry, std::vector<std::array<float, 3>>(geometry.voxel_count())};
  image.at(1, 2, 3) = {4.0F, -5.0F, 6.0F};
  const auto itk_image = seen_by_itk(image);
  EXPECT_EQ(itk_image->GetPixel({1, 2, 3})[1], -5.0F);
  const auto back = from_itk<std::array<float, 3>>(*itk_image);
  EXPECT_EQ(back.voxels, image.voxels);
  EXPECT_TRUE(same_geometry(back.geometry, geometry));
}

TEST(ImageGeometry, AThousandthOfAVoxelDecidesWhatIsTheSamePlace) {
  const auto geometry = grid_around(far_away, 9, {1.0, 1.0, 1.0}, oblique());
  auto moved = geometry;
  moved.origin.x() += 5e-4;
  EXPECT_TRUE(same_geometry(geometry, moved));
  moved.origin.x() += 5e-3;
  EXPECT_FALSE(same_geometry(geometry, moved));
  auto turned = geometry;
  turned.direction.col(1) *= -1.0;
  EXPECT_FALSE(same_geometry(geometry, turned));
  auto broken = geometry;
  broken.origin.x() = std::nan("");
  EXPECT_FALSE(same_geometry(geometry, broken));
}

TEST(ImageGeometry, APointOnTheOutermostHalfVoxelHasALabel) {
  auto geometry = grid_around(Eigen::Vector3d::Zero(), 3, {2.0, 2.0, 2.0}, oblique_left_handed());
  LabelMap labels{geometry, std::vector<std::uint16_t>(geometry.voxel_count(), 7)};
  labels.at(2, 0, 1) = 9;
  EXPECT_EQ(label_at(labels, geometry.to_world({2.499, -0.499, 1.0})), 9);
  EXPECT_EQ(label_at(labels, geometry.to_world({1.6, 0.4, 1.4})), 9);
  EXPECT_EQ(label_at(labels, geometry.to_world({2.501, 0.0, 1.0})), 0);
  EXPECT_EQ(label_at(labels, geometry.to_world({1.4, 0.0, 1.0})), 7);
  EXPECT_EQ(label_at(labels, Eigen::Vector3d::Constant(std::nan(""))), 0);
}

TEST(Geometry, LabelsOnAnotherGridAreTheNearest) {
  const auto fine = grid_around({1, 2, 3}, 40, Eigen::Vector3d::Ones(), oblique());
  const auto coarse = grid_around({1.13, 2.21, 3.32}, 22, {1.5, 2, 2.5}, oblique_left_handed());
  const LabelMap labels = ball(fine, {2, 2, 2}, 14);
  const LabelMap moved = on_grid(labels, coarse);
  const LabelMap expected =
      image_by<std::uint16_t>(coarse, [&](const Eigen::Vector3d& x) { return label_at(labels, x); });
  EXPECT_EQ(moved.voxels, expected.voxels);
  EXPECT_TRUE(same_geometry(moved.geometry, coarse));
  EXPECT_EQ(on_grid(labels, fine).voxels, labels.voxels);
}

/// As of FreeSurfer's map of 256 voxels and an image of 181: the grids are half a voxel apart along each axis.
TEST(Geometry, LabelsHalfwayBetweenVoxelsKeepTheirPlaceAndVolume) {
  const Eigen::Vector3d middle(1.2, -2.4, 0.7);
  for (const double coarser : {1.0, 2.0}) {
    const auto fine = grid_around({1, 2, 3}, 60, Eigen::Vector3d::Ones(), oblique());
    const auto other = grid_around({1, 2, 3}, static_cast<int>(60 / coarser) + (coarser == 1 ? 1 : 0),
                                   Eigen::Vector3d::Constant(coarser), oblique());
    const LabelMap labels = ball(fine, middle, 20), taken = on_grid(labels, other);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double count = 0, before = 0;
    for (int k = 0; k < other.size.z(); ++k) {
      for (int j = 0; j < other.size.y(); ++j) {
        for (int i = 0; i < other.size.x(); ++i) {
          sum += taken.at(i, j, k) * other.to_world(Eigen::Vector3d(i, j, k));
          count += taken.at(i, j, k);
        }
      }
    }
    for (const std::uint16_t label : labels.voxels) {
      before += label;
    }
    EXPECT_LE((sum / count - middle).norm(), 0.03) << coarser;
    EXPECT_NEAR(count * std::pow(coarser, 3), before, 0.005 * before) << coarser;
  }
}

TEST(Geometry, ASheetOneVoxelThickStaysWholeHalfwayBetweenVoxels) {
  const auto fine = grid_around({0, 0, 0}, 10, Eigen::Vector3d::Ones(), Eigen::Matrix3d::Identity());
  auto other = fine;
  other.origin.x() += 0.5;
  LabelMap labels{fine, std::vector<std::uint16_t>(fine.voxel_count(), 1)};
  for (int k = 0; k < 10; ++k) {
    for (int j = 0; j < 10; ++j) {
      labels.at(5, j, k) = 4;
    }
  }
  const LabelMap taken = on_grid(labels, other);
  for (int k = 0; k < 10; ++k) {
    for (int j = 0; j < 10; ++j) {
      EXPECT_EQ((taken.at(4, j, k) == 4 ? 1 : 0) + (taken.at(5, j, k) == 4 ? 1 : 0), 1) << j << ' ' << k;
    }
  }
}

TEST(Geometry, TheShareWithinAGridCountsVoxelsWithALabel) {
  const auto grid = grid_around({0, 0, 0}, 40, Eigen::Vector3d::Ones(), Eigen::Matrix3d::Identity());
  const auto half = grid_around({20, 0, 0}, 40, Eigen::Vector3d::Ones(), Eigen::Matrix3d::Identity());
  const LabelMap labels = ball(grid, {0, 0, 0}, 15);
  EXPECT_EQ(share_within(labels, grid), 1);
  EXPECT_NEAR(share_within(labels, half), 0.5, 0.02);
  EXPECT_EQ(share_within(labels, grid_around({90, 0, 0}, 9, Eigen::Vector3d::Ones(), Eigen::Matrix3d::Identity())), 0);
  EXPECT_EQ(share_within(ball(grid, {0, 0, 0}, -1), half), 1);
}

}  // namespace brainshift::test::geometry_test
