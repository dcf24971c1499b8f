// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/ensemble/each.hpp"
#include "solve/shape/shape_rows.hpp"

namespace brainshift::solve {

/// displacement_of() of each member: u = Σφû at the nodes, in the order of the rows, mm.
EachVectors displacement_of_each(const ShapeRows& nodal_rows, const EachVectors& parameters);

/// longest_difference() of each member; NaN where one is.
Numbers longest_difference_of_each(const EachVectors& a, const EachVectors& b);

}  // namespace brainshift::solve
