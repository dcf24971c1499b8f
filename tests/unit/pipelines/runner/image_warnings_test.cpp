// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/image_warnings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "tests/unit/pipelines/runner/expect_one.hpp"

namespace brainshift::pipelines::image_warnings_test {

TEST(ImageWarnings, TellOfLabelsWhereTheT1IsBlack) {
  LabelMap labels;
  labels.geometry.size = {10, 1, 1};
  labels.voxels = {0, 1, 1, 1, 1, 2, 2, 2, 2, 2};
  ScalarImage t1{labels.geometry, std::vector<float>(10, 5.0F)};
  t1.voxels[0] = 0;
  const std::vector<std::uint16_t> brain = {1, 2};
  EXPECT_TRUE(warnings_of(t1, labels, brain).empty());
  std::fill_n(t1.voxels.begin() + 1, 3, 0.0F);
  expect_one(warnings_of(t1, labels, brain), {"33 %", "one patient"});
}

TEST(ImageWarnings, TellOfLabelsWhoseBoundaryIsNoneInTheT1) {
  const auto bright = [](const Eigen::Vector3d& middle) {
    const ImageGeometry grid{.size = {60, 60, 60}};
    ScalarImage image{grid, std::vector<float>(grid.voxel_count())};
    LabelMap labels{grid, std::vector<std::uint16_t>(grid.voxel_count())};
    for (int k = 0; k < 60; ++k) {
      for (int j = 0; j < 60; ++j) {
        for (int i = 0; i < 60; ++i) {
          const bool inside = (Eigen::Vector3d(i, j, k) - middle).norm() < 18;
          labels.at(i, j, k) = inside ? 1 : 0;
          image.at(i, j, k) = inside ? 100.0F : 50.0F + static_cast<float>(i % 2);
        }
      }
    }
    return std::pair(image, labels);
  };
  const auto [t1, labels] = bright({30, 30, 30});
  const std::vector<std::uint16_t> brain = {1};
  EXPECT_TRUE(warnings_of(t1, labels, brain).empty());
  const auto warnings = warnings_of(t1, bright({38, 36, 30}).second, brain);
  expect_one(warnings, {"boundary of the labelled brain", "4 mm beside it", "one patient"});
}

}  // namespace brainshift::pipelines::image_warnings_test
