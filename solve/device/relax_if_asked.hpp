// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>

#include "segmentation/progress/progress.hpp"
#include "solve/device/relax_on_device.hpp"
#include "solve/dynamics/stepping.hpp"
#include "solve/interface/options.hpp"

namespace brainshift::solve::device {

/// relax() on this processor from where a device has left a body, one that is slow. options: of both together.
SteppingResult go_on(SteppingResult left, const Course& course, SolveOptions options, const Progress& progress);

/// A relaxation on a device where the options ask for one that can, and on from there on the CPU where it is slow;
/// nothing: all is to be done on the CPU. backend: nullptr: there is none. relax: does it there; leaves the body alone
/// where it throws DeviceFault. Throws as where_asked() does.
std::optional<SteppingResult> relax_where_asked(const Backend* backend, const Body& body, const Course& course,
                                                const SolveOptions& options, const Progress& progress,
                                                const std::function<Relaxed(const Backend&)>& relax);

/// Motion in time is the processor's. Tells so, or throws NotOnDevice, where the options ask for a GPU.
void leave_motion_to_processor(const SolveOptions& options, const Progress& progress);

/// relax_on_device.hpp on the GPU where the options ask for it: relax_where_asked().
std::optional<SteppingResult> relax_if_asked(Body& body, const Course& course, const SolveOptions& options,
                                             bool cautious, const Progress& progress);

}  // namespace brainshift::solve::device
