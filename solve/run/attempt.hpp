// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "segmentation/progress/progress.hpp"
#include "solve/interface/model.hpp"
#include "solve/interface/options.hpp"
#include "solve/interface/result.hpp"

namespace brainshift::solve {

/// The body with these options, once: prepared, started near its end where it may be, stepped, its error estimated.
/// known: measures that are known already.
SolveResult attempt(const Model& model, const SolveOptions& options, const SolveMeasures& known,
                    const Progress& progress);

/// Adds what an attempt took before what else it took.
void put_first(const std::string& what, std::string& took);

/// Whether the end does not depend on the way to it.
bool ends_alike(const Model& model, const SolveOptions& options);

/// Whether it is started from a coarse solution, and with what options that is made. Its displacement is then taken for
/// the parameters û, which is near enough for a start.
bool starts_coarse(const Model& model, const SolveOptions& options);
SolveOptions of_coarse_start(SolveOptions options);

/// Two layers of nodes determine no quadratic terms across them, however far supports grow. MMLS then leaves these to
/// its penalty, on supports half as wide again: it bends a sheet as linear functions do, in three to eight times the
/// steps.
bool too_thin_for_quadratic(const SolveOptions& options, const SolveMeasures& measures);

}  // namespace brainshift::solve
