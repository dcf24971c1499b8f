// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace brainshift::solve {

using PlanePoints = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;
using Values = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Past the values of the points used, over their range: how far an extended value may lie.
inline constexpr double extension_overshoot = 0.1;

/// Values (m × k) known at points of a plane (m × 2), extended to a place by the thin-plate spline of the thirty points
/// nearest to it (Duchon 1977), which is exact at the points and reproduces linear fields. Where the points do not fix
/// it (few, collinear, repeated) the least of its solutions is taken. Each value stays within those of the points used
/// and `extension_overshoot`, so that noise at neighbouring points cannot carry it far. m must not be 0.
Eigen::VectorXd extended(const PlanePoints& points, const Values& values, const Eigen::Vector2d& place);

}  // namespace brainshift::solve
