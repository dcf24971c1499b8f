// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/run_record.hpp"

#include <cmath>
#include <fstream>

#include "pipelines/runner/libraries.hpp"
#include "pipelines/runner/sha256.hpp"
#include "pipelines/runner/stage_folder.hpp"
#include "pipelines/scene/describe_scene.hpp"

namespace brainshift::pipelines {
namespace {

double rounded(double value) {
  return std::round(value * 1000) / 1000;
}

}  // namespace

nlohmann::ordered_json stage_entry(const StageReport& report, double seconds, double peak_memory_mb) {
  nlohmann::ordered_json entry = {{"status", report.failure.empty() ? "done" : "failed"},
                                  {"seconds", rounded(seconds)},
                                  {"peak_memory_mb", rounded(peak_memory_mb)},
                                  {"sizes", report.sizes},
                                  {"measures", report.measures}};
  if (!report.notes.empty()) {
    entry["notes"] = report.notes;
  }
  if (!report.failure.empty()) {
    entry["failure"] = report.failure;
  }
  return entry;
}

void write_stage_record(const std::filesystem::path& folder, const StageRecord& record) {
  const nlohmann::ordered_json json = {
      {"version", BRAINSHIFT_VERSION}, {"stamp", record.stamp}, {"failure", record.failure}, {"entry", record.entry}};
  write_whole(folder / "stage.json", json.dump(2) + "\n");
}

std::optional<StageRecord> read_stage_record(const std::filesystem::path& folder) {
  std::ifstream stream(folder / "stage.json");
  const auto json = nlohmann::ordered_json::parse(stream, nullptr, false);
  if (!json.is_object() || !json.contains("stamp") || !json["stamp"].is_string() || !json.contains("entry") ||
      !json["entry"].is_object()) {
    return std::nullopt;
  }
  return StageRecord{json["stamp"], json.value("failure", ""), json["entry"]};
}

nlohmann::ordered_json begin_run_record(const Scene& scene) {
  nlohmann::ordered_json inputs = nlohmann::ordered_json::array();
  for (const InputFile& file : scene_files(scene)) {
    inputs.push_back({{"role", file.role},
                      {"path", std::filesystem::absolute(file.path).lexically_normal().string()},
                      {"sha256", sha256_of_file(file.path)}});
  }
  return {{"version", BRAINSHIFT_VERSION},
          {"scene", std::filesystem::absolute(scene.source.file).lexically_normal().string()},
          {"inputs", std::move(inputs)},
          {"options", effective_options(scene)},
          {"threads", threads_in_use()},
          {"stages", nlohmann::ordered_json::object()}};
}

}  // namespace brainshift::pipelines
