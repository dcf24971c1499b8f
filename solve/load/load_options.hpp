// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/options/option.hpp"
#include "solve/load/craniotomy_load.hpp"

namespace brainshift::solve {

/// Name, range, unit and help of each option of the opening.
const OptionTable<OpeningOptions>& opening_options();

/// The same of a simulated craniotomy.
const OptionTable<SimulatedCraniotomy>& simulated_craniotomy_options();

}  // namespace brainshift::solve
