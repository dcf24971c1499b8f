// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/progress/progress.hpp"
#include "solve/interface/model.hpp"
#include "solve/interface/options.hpp"
#include "solve/interface/result.hpp"
#include "solve/run/thinned_body.hpp"

namespace brainshift::solve {

/// What measured points say of the weight, the noise and a rigid motion, by the thinned body: choose_weight().
/// conditions: at the nodes of the whole cloud. The covariance is the Posterior's. Throws as solve() does.
MeasuredFit fit_measured(const ThinnedBody& thinned, const Conditions& conditions);

/// Throws std::invalid_argument, naming it, with a part that noise does not go with: motion in time, the simplified
/// imposition, a region, cuts, tears, a septum, a resection, a plane problem.
void check_measured(const Model& model, const SolveOptions& options);

/// Conditions as a fit weighs them: with its weight and, where it has a smooth motion of the opening, what that leaves
/// of the noise taken out and the opening held.
Conditions weighed_conditions(Conditions conditions, const MeasuredFit& fit);

/// solve() of a model whose conditions were measured with noise: the prior is chosen on a cloud of some hundred of the
/// nodes, choose_weight(), unless the conditions name a weight. Throws as solve() and check_measured() do.
SolveResult solve_measured(const Model& model, const SolveOptions& options, const Progress& progress);

}  // namespace brainshift::solve
