// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "pipelines/phantom/head.hpp"
#include "segmentation/interface/options.hpp"

namespace brainshift::pipelines::t1_intensity_test {

using Eigen::Vector3d;
namespace tissue = segmentation::default_label;

const Vector3d centre(10, -20, 30);

/// Calls visit(place) at places in and about a head of scale 1.
template <class Visit>
void for_places(const Visit& visit) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> within(-100, 100);
  for (int i = 0; i < 20000; ++i) {
    visit(Vector3d(centre + Vector3d(within(random), within(random), within(random))));
  }
}

TEST(T1Intensity, TellsTheTissuesApartAsAScannerDoes) {
  const Head head = make_head(centre, 1, 3);
  std::map<std::uint16_t, std::pair<double, int>> sums;
  for_places([&](const Vector3d& place) {
    auto& [sum, count] = sums[tissue_at(head, place)];
    sum += t1_intensity(head, place, 1);
    ++count;
  });
  const auto mean = [&](std::uint16_t label) { return sums.at(label).first / sums.at(label).second; };
  EXPECT_LT(mean(0), 0.25 * mean(tissue::skull));
  EXPECT_LT(mean(tissue::skull), mean(tissue::csf));
  EXPECT_NEAR(mean(tissue::csf), mean(tissue::ventricles), 40) << "both are fluid";
  EXPECT_LT(mean(tissue::csf), 0.5 * mean(tissue::parenchyma));
  EXPECT_LT(mean(tissue::parenchyma), mean(tissue::skin));
}

TEST(T1Intensity, HasWhiteMatterWithinGreyAndATumourWithABrightRim) {
  const Head head = make_head(centre, 1, 3);
  double deep = 0, shallow = 0, rim = 0, core = 0;
  int deep_count = 0, shallow_count = 0;
  for_places([&](const Vector3d& place) {
    if (tissue_at(head, place) == tissue::parenchyma) {
      const double level = head.brain.level(place);
      const bool is_deep = level<0.4, is_shallow = level> 0.9;
      deep += is_deep ? t1_intensity(head, place, 1) : 0;
      shallow += is_shallow ? t1_intensity(head, place, 1) : 0;
      deep_count += is_deep ? 1 : 0;
      shallow_count += is_shallow ? 1 : 0;
    }
  });
  EXPECT_GT(deep / deep_count, shallow / shallow_count + 100);
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d reach = head.tumour.semi_axes[axis] * head.tumour.axes.col(axis);
    for (const double sign : {-1.0, 1.0}) {
      rim += t1_intensity(head, head.tumour.centre + 0.98 * sign * reach, 1) / 6;
      core += t1_intensity(head, head.tumour.centre + 0.3 * sign * reach, 1) / 6;
    }
  }
  EXPECT_GT(rim, core + 200);
}

TEST(T1Intensity, IsOneFunctionOfThePlaceInTheHead) {
  const Head small = make_head(Vector3d::Zero(), 0.5, 2), large = make_head(centre, 1, 2);
  for_places([&](const Vector3d& place) {
    ASSERT_NEAR(t1_intensity(small, 0.5 * (place - centre), 4), t1_intensity(large, place, 4), 1e-6);
  });
}

TEST(T1Intensity, IsTheSameForTheSameSeedAlone) {
  const Head head = make_head(centre, 1, 3);
  const Vector3d white = centre + Vector3d(30, 10, 10);
  ASSERT_EQ(tissue_at(head, white), tissue::parenchyma);
  EXPECT_EQ(t1_intensity(head, white, 1), t1_intensity(head, white, 1));
  EXPECT_NE(t1_intensity(head, white, 1), t1_intensity(head, white, 2));
}

}  // namespace brainshift::pipelines::t1_intensity_test
