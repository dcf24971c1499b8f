// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "segmentation/progress/progress.hpp"
#include "solve/interface/model.hpp"
#include "solve/interface/options.hpp"
#include "solve/interface/result.hpp"

namespace brainshift::solve {

/// Runs the stage: MTLED, to the steady state by adaptive dynamic relaxation or in time. Of a resection the solution
/// holds the nodes that it leaves, in the cloud's order. Throws std::invalid_argument when the model cannot be solved:
/// a label without a material, too few nodes for a support, constraints that contradict each other, nothing that holds
/// the body or a piece of it, a plane problem with contact or cells of three dimensions.
SolveResult solve(const Model& model, const SolveOptions& options, const Progress& progress = {});

/// Writes solution.vtu and history.csv into an existing folder, and where the result has them stress_strain.csv,
/// cut.vtp, steps.pvd and steps/. Throws std::runtime_error, naming the file, when one cannot be written whole.
void write_solve(const std::filesystem::path& folder, const SolveResult& result);

}  // namespace brainshift::solve
