// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/interface/solution.hpp"

namespace brainshift::solve {

/// The displacement field of a solution, by its own shape functions, at points (m × 3), mm.
Points displacement_at(const Solution& solution, const Points& points);

/// |u − v| over points of the body, mm.
struct FieldDifference {
  double largest = 0;
  double percentile_95 = 0;
  double mean = 0;
};

/// How far two displacements (m × 3) of the same m > 0 points lie apart.
FieldDifference field_difference(const Points& u, const Points& v);

/// How far two solutions lie apart: the field of `other` at the nodes of `reference`. The clouds may differ.
FieldDifference field_difference(const Solution& reference, const Solution& other);

}  // namespace brainshift::solve
