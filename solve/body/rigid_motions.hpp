// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace brainshift::solve {

/// The six rigid motions at a place, a column each: moves along x, y and z, then turns about them through the origin.
inline Eigen::Matrix<double, 3, 6> rigid_motions_at(const Eigen::Vector3d& x) {
  Eigen::Matrix<double, 3, 6> motions;
  motions << Eigen::Matrix3d::Identity(), Eigen::Matrix3d{{0, x.z(), -x.y()}, {-x.z(), 0, x.x()}, {x.y(), -x.x(), 0}};
  return motions;
}

}  // namespace brainshift::solve
