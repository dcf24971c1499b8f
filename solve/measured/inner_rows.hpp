// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/shape/shape_functions.hpp"

namespace brainshift::solve {

/// What is seen of a point inside the brain is the mean over a ball of this radius, mm: a landmark is a place of that
/// size, and a force at a point would sink in the more the finer the cloud is.
inline constexpr double seen_radius = 4.0;

/// Shape functions of the mean over the ball about each point (m × 3): its centre and the corners of an icosahedron.
/// Linear fields keep their value. No derivatives. Throws as ShapeFunctions::evaluate().
ShapeRows inner_rows(const ShapeFunctions& shape, const Points& points);

}  // namespace brainshift::solve
