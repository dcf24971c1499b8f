// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "segmentation/progress/progress.hpp"
#include "solve/dynamics/stepping.hpp"
#include "solve/interface/options.hpp"

namespace brainshift::solve::device {

/// relax() on this processor from where a device has left a body, one that is slow. options: of both together.
SteppingResult go_on(SteppingResult left, const Course& course, SolveOptions options, const Progress& progress);

/// relax_on_device.hpp on the GPU where the options ask for it, and on from there on the CPU where it is slow; nothing:
/// all is to be done on the CPU. Throws std::invalid_argument where the options want nothing but the GPU and it cannot
/// be.
std::optional<SteppingResult> relax_if_asked(Body& body, const Course& course, const SolveOptions& options,
                                             bool cautious, const Progress& progress);

}  // namespace brainshift::solve::device
