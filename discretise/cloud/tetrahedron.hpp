// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "segmentation/geometry/points.hpp"

namespace brainshift::discretise {

/// (4 × 3), one corner a row, mm.
using TetrahedronCorners = Eigen::Matrix<double, 4, 3>;

TetrahedronCorners corners_of(const Points& nodes, const std::array<std::int32_t, 4>& tetrahedron);

/// Signed, mm³: positive in VTK's order of corners.
double volume_of(const TetrahedronCorners& x);

/// Root of the mean squared edge, mm.
double mean_edge(const TetrahedronCorners& x);

/// Volume over the cubed mean edge, relative to a regular tetrahedron: 1 for that, 0 for a flat one.
double shape_quality(const TetrahedronCorners& x);

}  // namespace brainshift::discretise
