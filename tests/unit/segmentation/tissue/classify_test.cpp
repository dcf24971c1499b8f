// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/tissue/classify.hpp"

#include <gtest/gtest.h>

#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::classify_test {

using namespace segmentation;

constexpr double brain_radius = 22;
const Eigen::Vector3d centre(10, -40, 60);

/// Intensities of a ball of a brain, by the place from its centre: a dark middle, a dark sulcus, a grey rim.
double intensity(const Eigen::Vector3d& x) {
  const double r = x.norm();
  const bool dark = r < 7 || (r > 15 && std::abs(x.x()) < 1);
  return r > brain_radius ? 500 : dark ? 40 : r > 18 ? 80 : 110;
}

class Classify : public ::testing::Test {
 protected:
  const ImageGeometry grid_ = grid_around(centre, 50, Eigen::Vector3d::Ones(), oblique());
  const Mask brain_ = mask_of(ball(grid_, centre, brain_radius));
  const ScalarImage t1_ = image_by<float>(
      grid_, [](const Eigen::Vector3d& world) { return static_cast<float>(intensity(world - centre)); });
};

TEST_F(Classify, CallsDeepCsfVentricleAndCsfInASulcusParenchyma) {
  const Classification result =
      classify(t1_, brain_, {.ventricle_depth = 12, .closing = {}, .skull_label = {}, .fluid_label = {}});
  const auto at = [&](double x, double y, double z) {
    return label_at(result.labels, centre + Eigen::Vector3d(x, y, z));
  };
  EXPECT_EQ(at(0, 0, 0), default_label::ventricles);
  EXPECT_EQ(at(4, 3, -2), default_label::ventricles);
  EXPECT_EQ(at(0, 18, 0), default_label::parenchyma) << "in the sulcus";
  EXPECT_EQ(at(12, 0, 0), default_label::parenchyma);
  EXPECT_EQ(at(0, 0, 23), 0);
}

TEST_F(Classify, FillsTheBrainAndNothingElse) {
  const Classification result = classify(t1_, brain_, {});
  ASSERT_EQ(result.memberships.size(), 3U);
  for (std::size_t i = 0; i < brain_.voxels.size(); ++i) {
    ASSERT_EQ(result.labels.voxels[i] != 0, brain_.voxels[i] != 0);
    float sum = 0;
    for (const ScalarImage& membership : result.memberships) {
      sum += membership.voxels[i];
    }
    ASSERT_NEAR(sum, brain_.voxels[i], 1e-5);
  }
}

TEST_F(Classify, MembershipsAreDarkestFirst) {
  const Classification result = classify(t1_, brain_, {});
  const auto strongest = [&](const Eigen::Vector3d& x) {
    const Eigen::Array3i at = grid_.to_index(centre + x).array().round().cast<int>();
    std::size_t best = 0;
    for (std::size_t c = 1; c < 3; ++c) {
      const auto value = [&](std::size_t k) { return result.memberships[k].at(at.x(), at.y(), at.z()); };
      best = value(c) > value(best) ? c : best;
    }
    return best;
  };
  EXPECT_EQ(strongest({0, 0, 0}), 0U);
  EXPECT_EQ(strongest({20, 0, 0}), 1U);
  EXPECT_EQ(strongest({12, 0, 0}), 2U);
}

TEST_F(Classify, DoesNotSeeWhatLiesOutsideTheBrain) {
  ScalarImage other = t1_;
  for (std::size_t i = 0; i < other.voxels.size(); ++i) {
    other.voxels[i] = brain_.voxels[i] != 0 ? other.voxels[i] : -1000.0F;
  }
  EXPECT_EQ(classify(other, brain_, {}).labels.voxels, classify(t1_, brain_, {}).labels.voxels);
}

}  // namespace brainshift::test::classify_test
