// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "segmentation/geometry/points.hpp"

namespace brainshift::discretise {

/// Delaunay tetrahedra of points (CGAL, exact predicates), positively oriented; they fill the convex hull. The same
/// points give the same list in the same order.
std::vector<std::array<std::int32_t, 4>> delaunay_tetrahedra(const Points& points);

}  // namespace brainshift::discretise
