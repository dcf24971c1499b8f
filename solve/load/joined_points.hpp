// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "solve/load/craniotomy_load.hpp"

namespace brainshift::solve {

/// Points beyond so many, of the cortex and inside each, are joined with their neighbours.
inline constexpr int most_measured_points = 150;

/// All rows of a table of so many but these, which ascend.
std::vector<Eigen::Index> rows_but(const std::vector<Eigen::Index>& these, Eigen::Index all);

/// Rows of the points that are joined: those in one place; where these are more than `most`, those in one cell of the
/// finest cubic grid that suffices.
std::vector<std::vector<Eigen::Index>> joined_rows(const Points& positions, int most);

/// At most so many points: those of joined_rows() as their weighted mean, whose variance is 1/Σ(1/σ²). All as they are
/// where none are joined.
CraniotomyLoad joined(const CraniotomyLoad& load, int most);

}  // namespace brainshift::solve
