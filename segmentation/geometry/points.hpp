// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>

namespace brainshift {

/// Points, (n × 3), one a row, mm, LPS.
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Places, one a row.
inline Points as_points(std::span<const Eigen::RowVector3d> places) {
  Points points(static_cast<Eigen::Index>(places.size()), 3);
  for (std::size_t i = 0; i < places.size(); ++i) {
    points.row(static_cast<Eigen::Index>(i)) = places[i];
  }
  return points;
}

inline Points as_points(std::span<const Eigen::Vector3d> places) {
  Points points(static_cast<Eigen::Index>(places.size()), 3);
  for (std::size_t i = 0; i < places.size(); ++i) {
    points.row(static_cast<Eigen::Index>(i)) = places[i];
  }
  return points;
}

}  // namespace brainshift
