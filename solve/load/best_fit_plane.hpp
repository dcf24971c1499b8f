// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "segmentation/geometry/points.hpp"

namespace brainshift::solve {

/// A plane with two axes in it and its normal.
struct Plane3 {
  Eigen::RowVector3d origin;
  Eigen::Matrix3d axes;  ///< columns: along it, along it, normal

  /// Places (n × 3) in these axes: along it, along it, above it.
  Points local(const Points& places) const { return (places.rowwise() - origin) * axes; }
};

/// Through the middle of points (n × 3), nearest to them in squares; its first axis is that of their largest spread.
Plane3 best_fit_plane(const Points& points);

}  // namespace brainshift::solve
