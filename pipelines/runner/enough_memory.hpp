// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipelines/scene/scene.hpp"

namespace brainshift::pipelines {

/// Throws std::runtime_error, with what is needed and what would help, where a stage of ours from `from` to `until`
/// cannot be held in `available_mb` MiB: where even two thirds of its estimate are more, as estimates are at most half
/// too high (stage_memory.hpp). Looks at the headers of the images alone.
void require_memory(const Scene& scene, StageId from, StageId until, double available_mb);

}  // namespace brainshift::pipelines
