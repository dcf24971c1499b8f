// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "segmentation/progress/progress.hpp"
#include "solve/interface/options.hpp"

namespace brainshift::solve {

// What relaxation says of its way, on whatever it runs.

/// Too many steps. error_bound, tolerance: mm.
std::string not_converged(int steps, double error_bound, double tolerance);

/// Steps that are rounding since one of them.
std::string stands_still(int since, double error_bound, double tolerance, Precision precision);

/// Too many steps for single precision.
std::string outlasts_single(int steps, double error_bound, double tolerance);

/// Reports a window; done: what was reported so far, as a bound may rise.
void report_window(const Progress& progress, int steps, double time, double error_bound, double tolerance,
                   double& done);

}  // namespace brainshift::solve
