// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <random>

#include "segmentation/segment.hpp"
#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::drawn_head {

inline const Eigen::Vector3d centre(10.0, -40.0, 60.0);
inline constexpr double brain_radius = 30.0;
inline constexpr double ventricle_radius = 8.0;

/// A ball of a brain: grey rim, white inside, a round ventricle in the middle, dark sulci that run in from outside.
struct Head {
  ScalarImage t1;
  LabelMap mask;
  LabelMap labels;
};

inline bool in_sulcus(const Eigen::Vector3d& x) {
  return x.norm() > 22.0 && std::abs(x.x()) < 1.0;
}

inline Head head(const Eigen::Matrix3d& direction) {
  const auto geometry = grid_around(centre, 72, Eigen::Vector3d::Ones(), direction);
  std::mt19937 generator(7);
  std::normal_distribution<float> noise(0.0F, 3.0F);
  Head result;
  result.t1 = image_by<float>(geometry, [&](const Eigen::Vector3d& world) {
    const Eigen::Vector3d x = world - centre;
    const double r = x.norm();
    const double value = r > brain_radius                       ? 20.0
                         : r < ventricle_radius || in_sulcus(x) ? 40.0
                         : r > 25.0                             ? 80.0
                                                                : 110.0;
    return static_cast<float>(value) + noise(generator);
  });
  result.mask = ball(geometry, centre, brain_radius);
  result.labels = result.mask;
  const LabelMap ventricle = ball(geometry, centre, ventricle_radius);
  for (std::size_t i = 0; i < ventricle.voxels.size(); ++i) {
    result.labels.voxels[i] = static_cast<std::uint16_t>(result.labels.voxels[i] + ventricle.voxels[i]);
  }
  return result;
}

inline segmentation::SegmentOptions two_labels() {
  segmentation::SegmentOptions options;
  options.edge_length = 4.0;
  options.brain_labels = {1, 2};
  return options;
}

}  // namespace brainshift::test::drawn_head
