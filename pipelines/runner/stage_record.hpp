// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "pipelines/runner/stage_report.hpp"
#include "pipelines/scene/scene.hpp"

namespace brainshift::pipelines {

/// stage.json, in each stage's folder: what it was made from and what the stage said of itself. It travels with the
/// folder, so that folder and stamp cannot disagree.
struct StageRecord {
  std::string stage;  ///< its name
  std::string stamp;
  std::string failure;
  nlohmann::ordered_json entry;                                         ///< the stage's entry in run.json
  nlohmann::ordered_json artefacts = nlohmann::ordered_json::object();  ///< when it was read: artefacts_in the folder
};

/// What the stage did in so many seconds, with the largest memory of this process since reset_peak_memory().
StageRecord record_of(StageId stage, const std::string& stamp, const StageReport& report, double seconds);

/// With the artefacts that lie in the folder then.
void write_stage_record(const std::filesystem::path& folder, const StageRecord& record);

/// Empty when there is none that can be read.
std::optional<StageRecord> read_stage_record(const std::filesystem::path& folder);

}  // namespace brainshift::pipelines
