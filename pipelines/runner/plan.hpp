// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pipelines/runner/input_states.hpp"
#include "pipelines/runner/interruption.hpp"
#include "pipelines/runner/jobs.hpp"

namespace brainshift::pipelines {

struct InputFile {
  std::string role;  ///< "t1", "labels", "segment/brain.vtp", ...
  std::filesystem::path path;
};

/// A stage of a run, ready to be run or found unchanged.
struct StagePlan {
  StageId stage;
  std::vector<InputFile> inputs;       ///< the user's files and the artefacts of earlier stages; those that exist
  nlohmann::ordered_json options;      ///< all that its result depends on but the files' contents
  std::vector<std::string> artefacts;  ///< files that must be there afterwards
  std::function<StageReport(const std::filesystem::path& out, const Progress&)> work;
};

/// Plans a stage in a run's folder whose earlier stages are there.
StagePlan plan_stage(StageId stage, const Scene& scene, const std::filesystem::path& folder,
                     Interruption& interruption);

/// The solve stage's work on the artefacts of a run's folder.
SolveJob solve_job(const Scene& scene, const std::filesystem::path& folder);

/// The stamp of a stage: SHA-256 over the program's version, the options and the contents of the inputs. Where the
/// files lie and what they are called does not count. Throws std::invalid_argument when one cannot be read.
std::string stamp(const StagePlan& plan, InputStates& states);

/// The user's own files that a scene names, with their roles.
std::vector<InputFile> scene_files(const Scene& scene);

}  // namespace brainshift::pipelines
