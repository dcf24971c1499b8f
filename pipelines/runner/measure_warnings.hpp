// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipelines/runner/warnings.hpp"
#include "solve/interface/result.hpp"

namespace brainshift::pipelines {

/// Of few integration points, at all or under strong compression, of high pressure, of much that is pressed together,
/// and of what few nodes resolve.
Warnings warnings_of(const solve::SolveMeasures& measures);

/// Of tissues that many nodes hardly resolve, and of an error that nothing estimates.
std::vector<std::string> notes_of(const solve::SolveMeasures& measures);

}  // namespace brainshift::pipelines
