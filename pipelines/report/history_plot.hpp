// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "solve/solve.hpp"

namespace brainshift::pipelines {

/// How the solver converged, as an SVG element: the bound of the remaining error (mm) and the residual over the steps,
/// logarithmic, the loading phase shaded, the tolerance as a line (none where it is not positive). Empty for fewer than
/// two rows.
std::string convergence_plot(const std::vector<solve::HistoryRow>& history, double tolerance);

/// External work, strain energy, kinetic and dissipated energy (mJ) over the steps or, of a transient run, over time
/// (s). Empty for fewer than two rows.
std::string energy_plot(const std::vector<solve::HistoryRow>& history, solve::Dynamics dynamics);

}  // namespace brainshift::pipelines
