// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "pipelines/runner/input_states.hpp"
#include "pipelines/runner/interruption.hpp"
#include "pipelines/runner/jobs.hpp"
#include "pipelines/runner/stage_plan.hpp"

namespace brainshift::pipelines {

/// Plans a stage in a run's folder whose earlier stages are there.
StagePlan plan_stage(StageId stage, const Scene& scene, const std::filesystem::path& folder,
                     Interruption& interruption);

/// The solve stage's work on the artefacts of a run's folder.
SolveJob solve_job(const Scene& scene, const std::filesystem::path& folder);

/// The stamp of a stage: SHA-256 over the program's version, the options and the contents of the inputs. Where the
/// files lie and what they are called does not count. Throws std::invalid_argument when one cannot be read.
std::string stamp(const StagePlan& plan, InputStates& states);

}  // namespace brainshift::pipelines
