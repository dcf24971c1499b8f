// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solve/interface/model.hpp"
#include "solve/interface/options.hpp"
#include "solve/load/contradictions.hpp"
#include "solve/load/craniotomy_load.hpp"
#include "solve/run/thinned_body.hpp"

namespace brainshift::solve {

/// The measured points that contradict the others, the farthest off first: by the energy of the deformation alone as
/// prior, more than five standard deviations off, and five times farther than is usual of this load (where all are far
/// off, σ is too small, and no point is to blame). The others count with robust weights, as one wrong point hides
/// another. None of points inside the brain alone, where one near the opening moves as none of the others do. Throws as
/// solve() does.
std::vector<Outlier> outliers(const ThinnedBody& thinned, const Conditions& conditions);

/// Lets the measured points that contradict the others count for less: the conditions are made anew,
/// noisy_conditions(), without those that robust_trust() leaves nothing, and with the standard deviations of the
/// others raised by the root of their weights. Of a load of points with noise, not of a field. Throws as
/// solve_measured() and noisy_conditions() do, and std::invalid_argument where no point is on the cortex.
LessenedPoints lessen_outliers(Model& model, const SolveOptions& options, const OpeningOptions& opening);

}  // namespace brainshift::solve
