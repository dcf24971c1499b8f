// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/options/option.hpp"
#include "solve/interface/cut.hpp"
#include "solve/interface/options.hpp"

namespace brainshift::solve {

/// Name, range, unit and help of each option, those of the shape functions first.
const OptionTable<SolveOptions>& solve_options();

/// The same of a resection.
const OptionTable<Resection>& resection_options();

/// Throws std::invalid_argument with a sentence on a value that the table does not allow.
void check_options(const SolveOptions& options);

}  // namespace brainshift::solve
