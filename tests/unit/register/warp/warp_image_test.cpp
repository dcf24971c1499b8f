// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/warp/warp.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "register/registration.hpp"
#include "tests/unit/register/builders.hpp"

namespace brainshift::registration::warp_image_test {

using namespace builders;

const ImageGeometry small = grid({24, 20, 18}, {1.5, 1.5, 1.5});

Eigen::Vector3d shift_of(double x, double y, double z) {
  return {x, y, z};
}

TEST(Warp, WithAZeroFieldKeepsTheImageBitForBit) {
  const VectorImage zero = field(small, [](const Eigen::Vector3d&) { return Eigen::Vector3d::Zero(); });
  ScalarImage t1 = image(small, texture);
  t1.voxels[5] = -0.0F;
  for (const Interpolation interpolation : {Interpolation::linear, Interpolation::bspline}) {
    const ScalarImage warped = warp(t1, zero, interpolation);
    EXPECT_EQ(std::memcmp(warped.voxels.data(), t1.voxels.data(), t1.voxels.size() * sizeof(float)), 0);
  }
  const LabelMap labels = label_map(small, [](const Eigen::Vector3d& x) { return x.x() > 0 ? 7 : -3; });
  EXPECT_EQ(warp(labels, zero).voxels, labels.voxels);
}

TEST(Warp, OfALinearImageByAConstantFieldIsTheImageElsewhere) {
  const Eigen::Vector3d slope(1, -2, 0.5), d(2.2, -1.3, 0.7);
  const auto linear = [&](const Eigen::Vector3d& x) { return 50 + slope.dot(x - centre); };
  const VectorImage back = field(small, [&](const Eigen::Vector3d&) { return d; });
  const ScalarImage t1 = image(small, linear);
  const ScalarImage warped = warp(t1, back, Interpolation::linear);
  for_each_voxel(small, [&](const Eigen::Vector3d& y, std::size_t v) {
    const Eigen::Vector3d index = small.to_index(y + d);
    if ((index.array() >= 0).all() && (index.array() <= (small.size - 1).cast<double>()).all()) {
      ASSERT_NEAR(warped.voxels[v], linear(y + d), 1e-4);
    }
  });
}

TEST(Warp, BringsInZeroFromOutsideTheImage) {
  const VectorImage back = field(small, [](const Eigen::Vector3d&) { return shift_of(100, 0, 0); });
  const ScalarImage warped = warp(image(small, texture), back, Interpolation::linear);
  EXPECT_EQ(std::count(warped.voxels.begin(), warped.voxels.end(), 0.0F),
            static_cast<std::ptrdiff_t>(warped.voxels.size()));
}

TEST(Warp, BringsInZeroFromJustOutsideTheImageOnBothSides) {
  const ScalarImage t1 = image(small, texture);
  for (const double x : {-0.9, 0.9}) {  // 0.6 voxels
    const VectorImage back = field(small, [&](const Eigen::Vector3d&) { return shift_of(x, 0, 0); });
    const ScalarImage warped = warp(t1, back, Interpolation::linear);
    EXPECT_EQ(warped.at(x < 0 ? 0 : 23, 7, 7), 0);
    EXPECT_NE(warped.at(x < 0 ? 1 : 22, 7, 7), 0);
  }
}

TEST(Warp, BSplinesAreNearerToASmoothImageThanLinearInterpolation) {
  const Eigen::Vector3d d(0.75, 0.75, 0.75);
  const VectorImage back = field(small, [&](const Eigen::Vector3d&) { return d; });
  const auto error = [&](Interpolation interpolation) {
    const ScalarImage warped = warp(image(small, texture), back, interpolation);
    double largest = 0;
    for (int k = 5; k < 12; ++k) {
      for (int j = 5; j < 14; ++j) {
        for (int i = 5; i < 18; ++i) {
          const Eigen::Vector3d y = small.to_world(Eigen::Vector3d(i, j, k));
          largest = std::max(largest, std::abs(warped.at(i, j, k) - texture(y + d)));
        }
      }
    }
    return largest;
  };
  EXPECT_GT(error(Interpolation::linear), 1);
  EXPECT_LT(error(Interpolation::bspline), 0.1);
}

TEST(Warp, ReachesAnImageOnAnotherObliqueGrid) {
  const Eigen::Vector3d slope(1, -2, 0.5), d(1.2, -0.8, 0.6);
  const auto linear = [&](const Eigen::Vector3d& x) { return 80 + slope.dot(x - centre); };
  const VectorImage back = field(grid(), [&](const Eigen::Vector3d&) { return d; });
  const ImageGeometry other = grid({20, 16, 12}, {1.1, 0.9, 2.3}, oblique());
  const ScalarImage warped = warp(image(other, linear), back, Interpolation::linear);
  const LabelMap labels = label_map(other, [](const Eigen::Vector3d& x) { return x.z() > centre.z() ? 2 : 1; });
  const LabelMap warped_labels = warp(labels, back);
  EXPECT_TRUE(same_geometry(warped.geometry, other));
  for_each_voxel(other, [&](const Eigen::Vector3d& y, std::size_t v) {
    const Eigen::Vector3d index = other.to_index(y + d);
    if ((index.array() >= 0).all() && (index.array() <= (other.size - 1).cast<double>()).all()) {
      ASSERT_NEAR(warped.voxels[v], linear(y + d), 1e-4);
      ASSERT_EQ(warped_labels.voxels[v], label_at(labels, y + d));
    }
  });
}

TEST(Warp, TakesAVoxelThatTheFieldDoesNotReachAsUnmoved) {
  const VectorImage back = field(small, [](const Eigen::Vector3d&) { return shift_of(3, 0, 0); });
  ImageGeometry far = small;
  far.origin += Eigen::Vector3d(500, 0, 0);
  const ScalarImage t1 = image(far, texture);
  EXPECT_EQ(warp(t1, back, Interpolation::linear).voxels, t1.voxels);
}

TEST(Warp, RefusesBSplinesOnAnImageThatIsTooThin) {
  const ImageGeometry thin = grid({10, 10, 3});
  const VectorImage zero = field(thin, [](const Eigen::Vector3d&) { return Eigen::Vector3d::Zero(); });
  EXPECT_THROW(warp(image(thin, texture), zero, Interpolation::bspline), std::invalid_argument);
  EXPECT_EQ(warp(image(thin, texture), zero, Interpolation::linear).voxels, image(thin, texture).voxels);
}

TEST(Warp, CountsTheOutermostHalfVoxelAsInside) {
  const VectorImage back = field(small, [](const Eigen::Vector3d&) { return shift_of(-0.6, 0, 0); });  // 0.4 voxels
  const ScalarImage t1 = image(small, texture);
  const LabelMap labels = label_map(small, [](const Eigen::Vector3d&) { return 4; });
  const ScalarImage warped = warp(t1, back, Interpolation::linear);
  EXPECT_EQ(warped.at(0, 7, 7), t1.at(0, 7, 7));
  EXPECT_EQ(warp(labels, back).at(0, 7, 7), 4);
}

Eigen::Vector3d centroid(const ScalarImage& picture) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double total = 0;
  for_each_voxel(picture.geometry, [&](const Eigen::Vector3d& x, std::size_t v) {
    sum += picture.voxels[v] * x;
    total += picture.voxels[v];
  });
  return sum / total;
}

TEST(Warp, TakesABlobItsLabelItsPointAndItsSurfaceToTheSamePlace) {
  const Eigen::Vector3d blob = centre + Eigen::Vector3d(4, 2, 12);
  RegisterInput input = head(sinking, grid({72, 72, 72}, {1.1, 1.1, 1.1}, oblique()));
  input.t1 =
      image(input.t1.geometry, [&](const Eigen::Vector3d& x) { return 200 * std::exp(-(x - blob).squaredNorm() / 8); });
  input.labels = label_map(input.t1.geometry, [&](const Eigen::Vector3d& x) { return (x - blob).norm() < 4 ? 1 : 0; });
  input.landmarks.resize(1, 3);
  input.landmarks.row(0) = blob.transpose();
  const Registration result = register_images(input, {});
  const Eigen::Vector3d point = result.landmarks.row(0);
  ScalarImage label{result.warped.geometry, {}};
  label.voxels.assign(result.warped_labels->voxels.begin(), result.warped_labels->voxels.end());
  Surface surface = ball(blob, 4);
  surface.vertices = move_points(result.forward, surface.vertices);
  const Eigen::Vector3d middle = surface.vertices.colwise().mean();
  EXPECT_GT((point - blob).norm(), 5);  // it did move
  // The displacement is not quite linear over their own size: 0.1 to 0.2 mm.
  EXPECT_LT((centroid(result.warped) - point).norm(), 0.25);
  EXPECT_LT((middle - point).norm(), 0.25);
  // Nearest voxels: where all of them are displaced by about half a voxel, all are rounded the same way.
  EXPECT_LT((centroid(label) - point).norm(), 0.25 + 1.1 / 2);
}

TEST(WarpImage, OnAnotherGridIsWhatItIsThereOnItsOwn) {
  const ImageGeometry own = grid({40, 38, 36}, {1.2, 1.2, 1.2}), other = grid({9, 8, 7}, {4, 4, 4}, oblique());
  const auto slope = [](const Eigen::Vector3d& x) { return 100 + x.x() - 2 * x.z(); };
  const Eigen::Vector3d shift(1.5, -2, 3);
  const VectorImage resampling = field(own, [&](const Eigen::Vector3d&) { return shift; });
  const ScalarImage warped = warp(image(own, slope), resampling, Interpolation::linear, other);
  EXPECT_NEAR(warped.at(4, 4, 3), slope(other.to_world({4, 4, 3}) + shift), 1e-3);
  const LabelMap labels = label_map(own, [](const Eigen::Vector3d& x) { return x.z() > centre.z() ? 3 : 9; });
  const LabelMap moved = warp(labels, resampling, other);
  EXPECT_TRUE(same_geometry(moved.geometry, other));
  EXPECT_EQ(moved.at(4, 4, 3), label_at(labels, other.to_world({4, 4, 3}) + shift));
}

}  // namespace brainshift::registration::warp_image_test
