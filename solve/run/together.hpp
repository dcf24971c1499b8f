// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "segmentation/progress/progress.hpp"
#include "solve/interface/constants.hpp"
#include "solve/interface/options.hpp"

namespace brainshift::solve {

/// coarse_displacement() of a model with each of these constants, to rounding. They are prepared once and stepped
/// together, relax_together(), sixteen at a time, or 32 on the GPU where the options ask for it; those that cannot be
/// are solved alone. Throws DeviceFault and NotOnDevice as relax_together_if_asked() does.
std::vector<std::optional<Points>> coarse_displacements(const Model& model, const SolveOptions& options,
                                                        std::span<const Constants> constants, const Progress& progress);

/// The displacement, (n × 3) mm, of solve_whole_body() of a model with each of these constants, to rounding; absent
/// where that fails. Stepped together as above. The model has no resection.
std::vector<std::optional<Points>> whole_displacements(const Model& model, const SolveOptions& options,
                                                       std::span<const Constants> constants, const Progress& progress);

}  // namespace brainshift::solve
