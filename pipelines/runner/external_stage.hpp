// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "pipelines/runner/interruption.hpp"
#include "pipelines/runner/stage_plan.hpp"

namespace brainshift::pipelines {

/// Makes a stage's plan one of the command that the scene gives for it, and checks afterwards what the command wrote.
/// It may read all that is there before it; a script that it names counts by its contents.
void make_external(StagePlan& plan, const Scene& scene, const std::filesystem::path& folder,
                   Interruption& interruption);

}  // namespace brainshift::pipelines
