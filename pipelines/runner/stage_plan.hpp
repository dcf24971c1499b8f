// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pipelines/runner/jobs.hpp"
#include "pipelines/runner/stage_inputs.hpp"

namespace brainshift::pipelines {

/// A stage of a run, ready to be run or found unchanged.
struct StagePlan {
  StageId stage;
  std::vector<InputFile> inputs;       ///< the user's files and the artefacts of earlier stages; those that exist
  nlohmann::ordered_json options;      ///< all that its result depends on but the files' contents
  std::vector<std::string> artefacts;  ///< files that must be there afterwards
  std::function<StageReport(const std::filesystem::path& out, const Progress&)> work;
};

}  // namespace brainshift::pipelines
