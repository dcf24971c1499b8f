// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "solve/force/point_blocks.hpp"

namespace brainshift::solve {

/// B_a = ∂φ_a/∂X of a point's support, (3 × nodes) 1/mm.
Eigen::Matrix3Xd derivatives(const PointBlocks& points, std::int32_t point);

/// |B_a|, 1/mm.
std::vector<double> column_norms(const Eigen::Matrix3Xd& b);

}  // namespace brainshift::solve
