// SPDX-License-Identifier: GPL-3.0-or-later
//
// The synthetic head itself: what it says of its volumes, its surface and its frames is true.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "pipelines/phantom/phantom.hpp"
#include "segmentation/segment.hpp"

namespace brainshift::pipelines {
namespace {

using Eigen::Vector3d;
namespace tissue = segmentation::default_label;

constexpr std::uint16_t all_tissues[] = {tissue::parenchyma, tissue::ventricles, tissue::tumour,
                                         tissue::csf,        tissue::skull,      tissue::skin};

// Counting voxel centres misses a volume by chance at its surface: by about 0.3 voxel times the root of the number of
// voxels that the surface crosses. Five times that; the surface is at most that of four balls of the brain's volume.
double counting_error(double brain_volume, double spacing) {
  const double surface = 4 * std::cbrt(36 * std::numbers::pi * brain_volume * brain_volume);
  return 5 * 0.3 * std::sqrt(surface / (spacing * spacing)) * std::pow(spacing, 3);
}

TEST(Phantom, LabelVolumesAreTheStatedOnes) {
  for (const PhantomOptions& options : {PhantomOptions{}, PhantomOptions{.size = 64, .spacing = 3, .csf_gap = 3}}) {
    const Phantom phantom = make_phantom(options);
    const LabelMap labels = sample_labels(phantom);
    for (const std::uint16_t label : all_tissues) {
      const auto voxels = static_cast<double>(std::ranges::count(labels.voxels, label));
      EXPECT_NEAR(voxels * labels.geometry.voxel_volume(), tissue_volume(phantom.head, label),
                  counting_error(phantom.head.brain.volume(), options.spacing))
          << "tissue " << label;
    }
  }
}

TEST(Phantom, IsWhollyInItsImage) {
  const Phantom phantom = make_phantom({.size = 40, .spacing = 4});
  const LabelMap labels = sample_labels(phantom);
  const int last = labels.geometry.size.x() - 1;
  for (int a = 0; a <= last; ++a) {
    for (int b = 0; b <= last; ++b) {
      ASSERT_EQ(labels.at(0, a, b) + labels.at(last, a, b) + labels.at(a, 0, b) + labels.at(a, last, b) +
                    labels.at(a, b, 0) + labels.at(a, b, last),
                0);
    }
  }
}

TEST(Phantom, LiesInTheSamePlaceOfTheWorldInEveryFrame) {
  const Phantom oblique = make_phantom({.frame = PhantomFrame::oblique});
  const Phantom mirrored = make_phantom({.frame = PhantomFrame::mirrored});
  EXPECT_GT(oblique.geometry.direction.determinant(), 0.99);
  EXPECT_LT(mirrored.geometry.direction.determinant(), -0.99);
  EXPECT_GT((oblique.geometry.direction - Eigen::Matrix3d::Identity()).norm(), 0.3);
  const LabelMap a = sample_labels(oblique);
  const LabelMap b = sample_labels(mirrored);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> within(-60, 60);
  int same = 0;
  constexpr int places = 20000;
  for (int i = 0; i < places; ++i) {
    const Vector3d place = oblique.head.brain.centre + Vector3d(within(random), within(random), within(random));
    same += label_at(a, place) == label_at(b, place) ? 1 : 0;
  }
  EXPECT_GT(same, 0.95 * places);  // they differ within a voxel of a boundary
}

TEST(Phantom, MeasuredPointsLieOnTheBrainAndMoveInward) {
  const Phantom phantom = make_phantom({});
  for (Eigen::Index i = 0; i < phantom.load.positions.rows(); ++i) {
    const Vector3d point = phantom.load.positions.row(i);
    const Vector3d moved = point + phantom.load.displacement.row(i).transpose();
    EXPECT_NEAR(phantom.head.brain.level(point), 1, 1e-9);
    EXPECT_LT(phantom.head.brain.level(moved), 1);
  }
  EXPECT_NEAR(phantom.load.displacement.rowwise().norm().maxCoeff(), 8, 0.1);
}

TEST(Phantom, RefusesASizeThatShowsNothing) {
  EXPECT_THROW(make_phantom({.size = 4}), std::invalid_argument);
  EXPECT_THROW(make_phantom({.spacing = 0}), std::invalid_argument);
  EXPECT_THROW(make_phantom({.spacing = std::nan("")}), std::invalid_argument);
}

}  // namespace
}  // namespace brainshift::pipelines
