// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "segmentation/progress/progress.hpp"
#include "solve/interface/model.hpp"
#include "solve/interface/options.hpp"
#include "solve/interface/result.hpp"

namespace brainshift::solve {

/// solve() without a region: the resection is taken out, the rest prepared, started and stepped to the end.
SolveResult solve_whole_body(const Model& model, const SolveOptions& options, const Progress& progress);

/// Whether it is started from a coarse solution, and with what options that is made. Its displacement is then taken for
/// the parameters û, which is near enough for a start.
bool starts_coarse(const Model& model, const SolveOptions& options);
SolveOptions of_coarse_start(SolveOptions options);

/// Two layers of nodes determine no quadratic terms across them, however far supports grow. MMLS then leaves these to
/// its penalty, on supports half as wide again: it bends a sheet as linear functions do, in three to eight times the
/// steps.
bool too_thin_for_quadratic(const SolveOptions& options, const SolveMeasures& measures);

/// Whether nothing of the surface is free: the load then says how the volume changes, and so the pressure.
bool is_confined(const Model& model);

}  // namespace brainshift::solve
