// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "segmentation/progress/progress.hpp"
#include "solve/ensemble/relax_together.hpp"

namespace brainshift::solve::device {

/// relax_together.hpp on the GPU where the options ask for it; nothing: all is to be done on the CPU. loads: that
/// may_go_together(). Throws NotOnDevice where the options want nothing but the GPU and it cannot be, DeviceFault where
/// it fails then, and as EssentialConditions::factorise() does.
std::optional<std::vector<MemberResult>> relax_together_if_asked(const Body& body, std::span<const Member> loads,
                                                                 const LoadCurve& curve, const SolveOptions& options,
                                                                 const Progress& progress);

}  // namespace brainshift::solve::device
