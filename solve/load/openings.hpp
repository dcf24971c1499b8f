// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "solve/load/craniotomy_load.hpp"

namespace brainshift::solve {

/// The median distance from a point to its nearest neighbour, mm; 0 for points in one place. points (n × 3).
double usual_distance(const Points& points);

/// These of a load's points, with their deviations where it has any.
CraniotomyLoad rows_of(const CraniotomyLoad& load, const std::vector<Eigen::Index>& rows);

/// The load by its openings, those of the first points first. Two points belong to one where steps of at most three
/// times the usual distance between neighbours, or 30 mm where that is more, lead from one to the other, and points all
/// around others are of their opening. Between two openings nothing was measured: a spline across the cortex there
/// would prescribe what nobody saw.
std::vector<CraniotomyLoad> openings(const CraniotomyLoad& load);

}  // namespace brainshift::solve
