// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/read_mask.hpp"

#include <gtest/gtest.h>

#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::read_mask_test {

const ImageGeometry grid = grid_around({0, 0, 0}, 60, Eigen::Vector3d::Ones(), oblique());

/// A stripped brain, 20 mm across its middle, of noisy intensities.
float brain(const Eigen::Vector3d& x) {
  const double texture = std::sin(3 * x.x() + 5 * x.y() * x.y() - 7 * x.z());
  return x.norm() > 20 ? 0.0F : static_cast<float>(200 + 100 * texture);
}

/// What a spline leaves around it.
float rings(const Eigen::Vector3d& x) {
  return x.norm() > 28 || x.norm() <= 20 ? 0.0F : static_cast<float>(4 * std::cos(2 * x.norm()));
}

class ReadMaskTest : public ::testing::Test {
 protected:
  template <class Set>
  ReadMask read(const Set& set) const {
    write_image(folder_ / "mask.nii.gz", image_by<float>(grid, set));
    return read_mask_and_warning(folder_ / "mask.nii.gz");
  }
  ScratchFolder folder_;
  const Mask whole_ = mask_of(ball(grid, {0, 0, 0}, 20));
};

TEST_F(ReadMaskTest, RingsAroundAnImageThatASplineResampledAreNotInIt) {
  const ReadMask mask = read([](const auto& x) { return brain(x) + rings(x); });
  EXPECT_EQ(mask_of(mask.map).voxels, whole_.voxels);
  EXPECT_NE(mask.warning.find("mask.nii.gz: 59 ml"), std::string::npos) << mask.warning;
  EXPECT_NE(mask.warning.find("resampled by splines"), std::string::npos) << mask.warning;
}

TEST_F(ReadMaskTest, DarkFluidInsideIsKeptBesideRings) {
  const ReadMask mask = read([](const Eigen::Vector3d& x) {
    const bool aqueduct = std::hypot(x.x(), x.y()) <= 1 && x.z() > 0;
    return x.norm() <= 8 || (aqueduct && x.norm() <= 20) ? 1.0F : brain(x) + rings(x);
  });
  EXPECT_NEAR(static_cast<double>(count(mask_of(mask.map))), static_cast<double>(count(whole_)), 30);
  EXPECT_FALSE(mask.warning.empty());
}

/// Each has many voxels near 0 beside its largest.
TEST_F(ReadMaskTest, WhatIsNotZeroIsInAMaskThatWasNotResampled) {
  const auto expect_whole = [&](const char* what, const auto& set) {
    const ReadMask mask = read([&](const Eigen::Vector3d& x) { return x.norm() > 20 ? 0.0F : set(x); });
    EXPECT_EQ(mask_of(mask.map).voxels, whole_.voxels) << what;
    EXPECT_EQ(mask.warning, "") << what;
  };
  expect_whole("a stripped T1", brain);
  expect_whole("with a few dark voxels", [](const auto& x) { return x.norm() > 19.9 ? -1.0F : brain(x); });
  expect_whole("numbers of an atlas", [](const auto& x) { return x.x() > 0 ? 2.0F : x.z() > 0 ? 41.0F : 2035.0F; });
  expect_whole("intensities about their mean", [](const auto& x) { return (brain(x) - 201) / 80; });
  expect_whole("a mask of -1", [](const auto&) { return -1.0F; });
}

}  // namespace brainshift::test::read_mask_test
