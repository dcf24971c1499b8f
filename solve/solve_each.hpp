// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "segmentation/progress/progress.hpp"
#include "solve/interface/constants.hpp"
#include "solve/interface/options.hpp"

namespace brainshift::solve {

/// A study of materials: the displacement at the nodes, (n × 3) mm, of a model with each of these constants in place of
/// its own, to rounding what solve() gives; absent where that finds no rest. The body is prepared once, and once more
/// where one tissue becomes stiffer than another, three times or thirty times as stiff. Its members are stepped
/// together, 32 at a time on a GPU, else sixteen, which take about three times as long as one of 12,000 nodes
/// (ensemble/README.md). What cannot be stepped together is solved one by one. Gravity and fluid, too, are those of the
/// constants. Throws as solve() does, and std::invalid_argument where constants lack a material of the model, and with
/// what it does not go with: a load with noise, motion in time, a region, a resection.
std::vector<std::optional<Points>> solve_each(const Model& model, const SolveOptions& options,
                                              std::span<const Constants> constants, const Progress& progress = {});

}  // namespace brainshift::solve
