// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "segmentation/progress/progress.hpp"
#include "solve/ensemble/relax_together.hpp"

namespace brainshift::solve::device {

struct Backend;

/// solve::relax_together() of any number of loads wholly on a device, `most_members` at a time: after each window of
/// steps the host gets some sums of each member, goes by the same rules, and says how to go on. Each ends, to rounding,
/// where and when it ends there or alone by BoundOf::parameters: on one kind of device with the same bits whatever the
/// others are, if their laws are of the same kinds. Unlike there the load of each comes at a pace of its own. All start
/// from rest, or all from their start. Throws DeviceFault, and as EssentialConditions::factorise() does.
std::vector<MemberResult> relax_together(const Backend& backend, const Body& body, std::span<const Member> loads,
                                         const LoadCurve& curve, const SolveOptions& options, const Progress& progress);

}  // namespace brainshift::solve::device
