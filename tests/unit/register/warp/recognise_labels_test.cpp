// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/warp/recognise_labels.hpp"

#include <gtest/gtest.h>

#include "tests/unit/register/builders.hpp"

namespace brainshift::registration::recognise_labels_test {

using namespace builders;

const ImageGeometry g = grid({24, 22, 20});

Eigen::Array3i voxel(const Eigen::Vector3d& x) {
  return g.to_index(x).array().round().cast<int>();
}

TEST(RecogniseLabels, ByFewWholeNumbersInPatches) {
  EXPECT_TRUE(looks_like_labels(image(g, [](const Eigen::Vector3d& x) { return x.x() > 3 ? 1 : 0; })));
  EXPECT_TRUE(looks_like_labels(image(g, [](const Eigen::Vector3d& x) {
    return 1000 + std::floor(x.x() / 6) + 10 * std::floor(x.y() / 6) + 100 * std::floor(x.z() / 6);
  })));
}

/// Two voxels thick and two wide, as cortical regions are at 2 mm; single voxels, as contacts of an electrode.
TEST(RecogniseLabels, InThinPatchesAndAloneInTheBackground) {
  EXPECT_TRUE(looks_like_labels(image(g, [](const Eigen::Vector3d& x) {
    const Eigen::Array3i v = voxel(x);
    return std::abs(2 * v.x() - v.y()) < 2 ? 1000 + v.y() / 2 + 20 * (v.z() / 2) : 0;
  })));
  EXPECT_TRUE(looks_like_labels(image(g, [](const Eigen::Vector3d& x) {
    const Eigen::Array3i v = voxel(x);
    return (v.unaryExpr([](int i) { return i % 4; }) == 2).all() ? v.x() + 30 * v.y() + 900 * v.z() : 0;
  })));
}

TEST(RecogniseLabels, NotASliceOfOneVoxel) {
  for (const Eigen::Array3i& size : {Eigen::Array3i(1, 22, 20), Eigen::Array3i(24, 22, 1)}) {
    EXPECT_FALSE(looks_like_labels(image(grid(size), [](const Eigen::Vector3d& x) { return std::round(texture(x)); })));
  }
}

/// -1 of more is a background that cannot be read: refused where it is read, not interpolated.
TEST(RecogniseLabels, WithAFewNegativeOnesIsAContrast) {
  EXPECT_FALSE(looks_like_labels(image(g, [](const Eigen::Vector3d& x) { return x.x() > 3 ? 1 : -1; })));
  EXPECT_TRUE(looks_like_labels(
      image(g, [](const Eigen::Vector3d& x) { return x.x() > 3 ? std::floor(std::abs(x.y()) / 6) : -1; })));
  EXPECT_TRUE(looks_like_labels(image(g, [](const Eigen::Vector3d& x) {
    return x.x() > 3 ? 1000 + std::floor(x.y() / 4) + 10 * std::floor(x.z() / 4) : -1;
  })));
}

TEST(RecogniseLabels, NotAnMriOfBytesNorNumbersBetween) {
  EXPECT_FALSE(looks_like_labels(image(g, [](const Eigen::Vector3d& x) { return std::round(texture(x)); })));
  EXPECT_FALSE(looks_like_labels(image(g, [](const Eigen::Vector3d& x) { return x.x() > 3 ? 0.5 : 0; })));
  EXPECT_FALSE(looks_like_labels(image(g, [](const Eigen::Vector3d& x) { return x.x() > 3 ? 40 : -1000; })));
  EXPECT_FALSE(looks_like_labels(image(g, [](const Eigen::Vector3d& x) {
    return x.z() > centre.z() ? std::round(texture(x)) : 7;  // a background that is not 0
  })));
  int next = 0;
  EXPECT_FALSE(looks_like_labels(image(g, [&](const Eigen::Vector3d&) { return next++; })));
}

}  // namespace brainshift::registration::recognise_labels_test
