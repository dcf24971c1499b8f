// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solve/solve.hpp"
#include "tests/verification/figures.hpp"
#include "tests/verification/reference.hpp"

namespace brainshift::verification {

/// How far a solution is from its reference: largest difference, 95 % and mean, in per cent of the reference's largest
/// displacement. The 95 % may be 2 % at most, the mean most_mean.
std::vector<Figure> relative_figures(const solve::SolveResult& result, const Reference& reference, double most_mean);

}  // namespace brainshift::verification
