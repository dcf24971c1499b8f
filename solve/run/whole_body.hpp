// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/progress/progress.hpp"
#include "solve/interface/model.hpp"
#include "solve/interface/options.hpp"
#include "solve/interface/result.hpp"

namespace brainshift::solve {

/// solve() without a region: the resection is taken out, the rest prepared, started and stepped to the end.
SolveResult solve_whole_body(const Model& model, const SolveOptions& options, const Progress& progress);

}  // namespace brainshift::solve
