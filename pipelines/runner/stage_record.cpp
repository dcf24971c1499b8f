// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/stage_record.hpp"

#include <cmath>
#include <fstream>

#include "pipelines/runner/artefacts.hpp"
#include "pipelines/runner/json_text.hpp"
#include "pipelines/runner/peak_memory.hpp"
#include "pipelines/runner/stage_folder.hpp"

namespace brainshift::pipelines {
namespace {

double rounded(double value) {
  return std::round(value * 1000) / 1000;
}

}  // namespace

StageRecord record_of(StageId stage, const std::string& stamp, const StageReport& report, double seconds) {
  nlohmann::ordered_json entry = {{"status", report.failure.empty() ? "done" : "failed"},
                                  {"seconds", rounded(seconds)},
                                  {"peak_memory_mb", rounded(peak_memory_mb())},
                                  {"sizes", report.sizes},
                                  {"measures", report.measures}};
  if (!report.notes.empty()) {
    entry["notes"] = report.notes;
  }
  if (!report.failure.empty()) {
    entry["failure"] = report.failure;
  }
  return {.stage = std::string(stage_name(stage)), .stamp = stamp, .failure = report.failure, .entry = entry};
}

void write_stage_record(const std::filesystem::path& folder, const StageRecord& record) {
  const nlohmann::ordered_json json = {{"version", BRAINSHIFT_VERSION}, {"stage", record.stage},
                                       {"stamp", record.stamp},         {"failure", record.failure},
                                       {"entry", record.entry},         {"artefacts", artefacts_in(folder)}};
  write_whole(folder / "stage.json", json_text(json));
}

std::optional<StageRecord> read_stage_record(const std::filesystem::path& folder) {
  std::ifstream stream(folder / "stage.json");
  const auto json = nlohmann::ordered_json::parse(stream, nullptr, false);
  const auto has = [&json](const char* name, nlohmann::ordered_json::value_t type) {
    return json.contains(name) && json[name].type() == type;
  };
  using Type = nlohmann::ordered_json::value_t;
  const bool names_stage = json.contains("stage");  // earlier versions do not
  if (!json.is_object() || (names_stage && !has("stage", Type::string)) || !has("stamp", Type::string) ||
      !has("failure", Type::string) || !has("entry", Type::object) || !has("artefacts", Type::object)) {
    return std::nullopt;
  }
  return StageRecord{.stage = names_stage ? json["stage"] : "",
                     .stamp = json["stamp"],
                     .failure = json["failure"],
                     .entry = json["entry"],
                     .artefacts = json["artefacts"]};
}

}  // namespace brainshift::pipelines
