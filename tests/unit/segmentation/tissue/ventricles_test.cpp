// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/tissue/ventricles.hpp"

#include <gtest/gtest.h>

#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::ventricles_test {

using segmentation::find_ventricles;

constexpr double brain_radius = 24, ventricle_depth = 10;
const Eigen::Vector3d centre(10, -40, 60);
const ImageGeometry grid = grid_around(centre, 54, Eigen::Vector3d::Ones(), oblique_left_handed());

/// The places of the brain, from its centre, for which `inside` holds.
template <class Inside>
Mask within_brain(const Inside& inside) {
  return image_by<std::uint8_t>(grid, [&](const Eigen::Vector3d& world) {
    const Eigen::Vector3d x = world - centre;
    return static_cast<std::uint8_t>(x.norm() <= brain_radius && inside(x) ? 1 : 0);
  });
}

const Mask brain = within_brain([](const Eigen::Vector3d&) { return true; });

bool in_ventricle(const Eigen::Vector3d& x) {
  return x.norm() <= 7;
}

TEST(Ventricles, ABodyDeepInTheBrainIsOneWhole) {
  const Mask csf = within_brain(in_ventricle);
  EXPECT_EQ(find_ventricles(csf, brain, ventricle_depth).voxels, csf.voxels);
}

TEST(Ventricles, SheetsThatHangOnABodyAreLeftOut) {
  const auto in_sheet = [](const Eigen::Vector3d& x) { return std::abs(x.x()) < 0.9; };
  const Mask csf = within_brain([&](const Eigen::Vector3d& x) { return in_ventricle(x) || in_sheet(x); });
  const Mask found = find_ventricles(csf, brain, ventricle_depth);
  const Mask ventricle = within_brain(in_ventricle);
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < found.voxels.size(); ++i) {
    EXPECT_GE(found.voxels[i], ventricle.voxels[i]);
    beyond += found.voxels[i] > ventricle.voxels[i] ? 1 : 0;
  }
  EXPECT_LT(beyond, count(ventricle) / 10);
}

TEST(Ventricles, AWideCleftThatReachesUpToTheSurfaceIsNone) {
  const auto in_cleft = [](const Eigen::Vector3d& x) { return x.x() > 6 && std::abs(x.y()) < 5; };
  EXPECT_EQ(count(find_ventricles(within_brain(in_cleft), brain, ventricle_depth)), 0U);
}

TEST(Ventricles, ABodyThatHangsOnAWideCleftComesLoose) {
  const auto hanging = [](const Eigen::Vector3d& x) { return x.norm() <= 6.5; };
  const auto in_neck = [](const Eigen::Vector3d& x) { return x.x() > 0 && x.tail<2>().norm() < 2.2; };
  const auto in_cleft = [](const Eigen::Vector3d& x) { return x.x() > 10 && std::abs(x.y()) < 6; };
  const Mask found =
      find_ventricles(within_brain([&](const Eigen::Vector3d& x) { return hanging(x) || in_neck(x) || in_cleft(x); }),
                      brain, ventricle_depth);
  const auto share_of = [&](const Mask& part) {
    std::size_t both = 0;
    for (std::size_t i = 0; i < part.voxels.size(); ++i) {
      both += found.voxels[i] != 0 && part.voxels[i] != 0 ? 1 : 0;
    }
    return static_cast<double>(both) / static_cast<double>(count(part));
  };
  EXPECT_GT(share_of(within_brain(hanging)), 0.95);
  EXPECT_LT(share_of(within_brain(in_cleft)), 0.02);
}

TEST(Ventricles, TheDepthAskedForDecides) {
  const auto in_body = [](const Eigen::Vector3d& x) { return (x - Eigen::Vector3d(12, 0, 0)).norm() <= 5; };
  const Mask csf = within_brain(in_body);
  EXPECT_GT(count(find_ventricles(csf, brain, 6)), 0U);
  EXPECT_EQ(count(find_ventricles(csf, brain, 18)), 0U);
}

TEST(Ventricles, ABodyOfATwentiethOfTheLargestIsLeftOut) {
  const Eigen::Vector3d place(0, 0, 12);
  const auto with_ball = [&](double radius) {
    return within_brain([&](const Eigen::Vector3d& x) { return in_ventricle(x) || (x - place).norm() <= radius; });
  };
  const auto voxel = [&](const Mask& mask) {
    const Eigen::Array3i at = grid.to_index(centre + place).array().round().cast<int>();
    return mask.at(at.x(), at.y(), at.z());
  };
  EXPECT_EQ(voxel(find_ventricles(with_ball(2.4), brain, ventricle_depth)), 0);
  EXPECT_EQ(voxel(find_ventricles(with_ball(4), brain, ventricle_depth)), 1);
}

TEST(Ventricles, OfABrainWithoutCsfAreNone) {
  EXPECT_EQ(count(find_ventricles(within_brain([](const Eigen::Vector3d&) { return false; }), brain, 10)), 0U);
}

}  // namespace brainshift::test::ventricles_test
