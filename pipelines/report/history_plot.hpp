// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "pipelines/report/plot.hpp"
#include "solve/solve.hpp"

namespace brainshift::pipelines {

/// How the solver converged: the bound of the remaining error (mm) and the residual over the steps, logarithmic, the
/// loading phase shaded, the tolerance as a line (none where it is not positive). None for fewer than two rows, and
/// where no value is positive.
std::optional<Plot> convergence_plot(const std::vector<solve::HistoryRow>& history, double tolerance);

/// External work, strain energy, kinetic and dissipated energy (mJ) over the steps or, of a transient run, over time
/// (s). None for fewer than two rows, and where no value is positive.
std::optional<Plot> energy_plot(const std::vector<solve::HistoryRow>& history, solve::Dynamics dynamics);

}  // namespace brainshift::pipelines
