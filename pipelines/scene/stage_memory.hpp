// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "pipelines/scene/run_size.hpp"
#include "pipelines/scene/scene.hpp"

namespace brainshift::pipelines {

/// The most memory that a stage of ours holds at once, as run.json's peak_memory_mb counts it (MiB, the program and its
/// libraries with it), on any number of threads: no less than it takes, and no more than half above. Empty where nobody
/// can know: adaptive integration adds points as it goes. Not counted are further files that are to be warped, and
/// cuts.
std::optional<double> stage_memory(StageId stage, const Scene& scene, const RunSize& size);

}  // namespace brainshift::pipelines
