// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/progress/progress.hpp"
#include "solve/interface/model.hpp"
#include "solve/interface/options.hpp"
#include "solve/interface/result.hpp"

namespace brainshift::solve {

/// What the measured points of a model say of the weight, the noise and a rigid motion, by a linear body of some
/// hundred of the nodes: choose_weight(). Throws as solve() does.
MeasuredFit fit_measured(const Model& model, const SolveOptions& options);

/// solve() of a model whose conditions were measured with noise: the weight is chosen on a cloud of some hundred of the
/// nodes, choose_weight(), unless the conditions name one. Throws as solve() does, and std::invalid_argument with a
/// part that noise does not go with: motion in time, the simplified imposition, a region, cuts, tears, a resection, a
/// plane problem.
SolveResult solve_measured(const Model& model, const SolveOptions& options, const Progress& progress);

}  // namespace brainshift::solve
