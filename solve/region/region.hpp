// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/progress/progress.hpp"
#include "solve/interface/model.hpp"
#include "solve/interface/options.hpp"
#include "solve/interface/result.hpp"

namespace brainshift::solve {

/// Solves only where the body moves, options.region > 0 mm:
///   1. a coarse solution of the whole body: an even eighth of the nodes, one point a cell (coarse.hpp);
///   2. the region: the background cells in which the coarse solution moves by more, and those about them. Kept are all
///      nodes in the supports of their integration points, whose shape functions are so those of the whole cloud. Nodes
///      that a point left out sees too, the rim, take their parameters from the coarse solution;
///   3. the solution of the region; outside it the displacement is the coarse one.
/// The result covers the whole cloud; reaction forces are those of the region's loaded nodes, 0 elsewhere. Energies in
/// the history are the region's, with the work done at its rim. Where everything is kept, where the body is too small
/// for a coarse cloud, or where the coarse solution proves wrong by more than three quarters of options.region next to
/// the rim, it is solve_whole_body(). Throws std::invalid_argument as solve() and check_region() do, and when nothing
/// moves by more than the region.
SolveResult solve_region(const Model& model, const SolveOptions& options, const Progress& progress);

/// Throws std::invalid_argument with a sentence when the model or the options hold what a region does not go with.
void check_region(const Model& model, const SolveOptions& options);

}  // namespace brainshift::solve
