// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace brainshift {

/// The place on the segment from a to b, which may be one point, that is nearest to x.
inline Eigen::Vector3d nearest_on_segment(const Eigen::Vector3d& x, const Eigen::Vector3d& a,
                                          const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double squared = along.squaredNorm();
  return squared > 0 ? Eigen::Vector3d(a + std::clamp((x - a).dot(along) / squared, 0.0, 1.0) * along) : a;
}

}  // namespace brainshift
