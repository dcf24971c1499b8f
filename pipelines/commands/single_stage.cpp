// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <optional>
#include <set>
#include <string>

#include "pipelines/checksum/sha256.hpp"
#include "pipelines/commands/commands.hpp"
#include "pipelines/commands/console.hpp"
#include "pipelines/runner/peak_memory.hpp"
#include "pipelines/runner/stage_folder.hpp"
#include "pipelines/runner/stage_record.hpp"
#include "segmentation/files/refuse.hpp"

namespace brainshift::pipelines {

namespace {

/// What an earlier time of the stage left there. Throws std::invalid_argument where it is another stage's.
std::optional<StageRecord> earlier_record(StageId stage, const std::filesystem::path& out) {
  auto earlier = read_stage_record(out);
  if (earlier && !earlier->stage.empty() && earlier->stage != stage_name(stage)) {
    refuse(out, "this is the folder of the stage " + earlier->stage + "; choose another with --out");
  }
  return earlier;
}

std::set<std::string> own_files(const std::optional<StageRecord>& earlier) {
  std::set<std::string> own;
  if (earlier) {
    own.insert("stage.json");
    for (const auto& [name, state] : earlier->artefacts.items()) {
      own.insert(name);
    }
  }
  return own;
}

/// Among new artefacts old ones, as of a cut that is not there any more, would be taken for theirs.
void remove_left_over(const std::optional<StageRecord>& earlier, const std::filesystem::path& out) {
  const auto now = read_stage_record(out);
  for (const std::string& name : own_files(earlier)) {
    const std::filesystem::path file = out / name;
    if (name != "stage.json" && now && !now->artefacts.contains(name) && std::filesystem::is_regular_file(file) &&
        sha256_of_file(file) == earlier->artefacts[name].value("sha256", "")) {
      std::filesystem::remove(file);
    }
  }
}

}  // namespace

void run_single_stage(StageId stage, const std::filesystem::path& out, const Settings& settings,
                      const std::function<StageReport(const std::filesystem::path& folder, const Progress&)>& work) {
  Console console(settings.quiet, settings.verbose);
  const std::optional<StageRecord> earlier = earlier_record(stage, out);
  console.started(stage);
  StageFolder folder(out, *settings.interruption);
  reset_peak_memory();
  const auto begin = std::chrono::steady_clock::now();
  const StageReport report =
      work(folder.path(), [&](double fraction, std::string_view what) { console.progress(stage, fraction, what); });
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  write_stage_record(folder.path(), {.stage = std::string(stage_name(stage)),
                                     .stamp = "",
                                     .failure = report.failure,
                                     .entry = stage_entry(report, seconds, peak_memory_mb())});
  folder.refuse_others_files(own_files(earlier));
  folder.merge();
  remove_left_over(earlier, out);
  for (const std::string& note : report.notes) {
    console.note(stage, note);
  }
  if (!report.failure.empty()) {
    console.failed(stage);
    throw NotConverged(report.failure);
  }
  console.finished(stage, seconds);
}

}  // namespace brainshift::pipelines
