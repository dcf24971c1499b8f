// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/checksum/sha256.hpp"
#include "pipelines/commands/commands.hpp"
#include "pipelines/commands/console.hpp"
#include "pipelines/runner/peak_memory.hpp"
#include "pipelines/runner/stage_folder.hpp"
#include "pipelines/runner/stage_record.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/progress/stopwatch.hpp"

namespace brainshift::pipelines {

namespace {

/// What an earlier stage left there. Throws std::invalid_argument where it is another stage of a run.
std::optional<StageRecord> earlier_record(StageId stage, const std::filesystem::path& out) {
  auto earlier = read_stage_record(out);
  if (earlier && !earlier->stamp.empty() && !earlier->stage.empty() && earlier->stage != stage_name(stage)) {
    refuse(out, "this is the folder of the stage " + earlier->stage + " of a run; choose another with --out");
  }
  return earlier;
}

/// Throws std::invalid_argument where a file of the stage's main ones lies there already: it may be a patient's. Of the
/// others that is seen once they are made.
void refuse_before_work(StageId stage, const std::filesystem::path& out) {
  static const std::array<std::vector<const char*>, all_stages.size()> main_files = {{
      {"labels.nii.gz", "brain.vtp", "skull.vtp"},
      {"nodes.vtu", "cells.vtu"},
      {"solution.vtu", "history.csv", "load.csv"},
      {"warped.nii.gz", "warped_labels.nii.gz", "landmarks.csv"},
      {"index.html"},
  }};
  for (const char* name : main_files[index_of(stage)]) {
    if (std::filesystem::exists(out / name)) {
      refuse_to_replace(out / name);
    }
  }
}

/// Among new artefacts old ones of the stage, as of a cut that is not there any more, would be taken for theirs.
void remove_left_over(const StageRecord& earlier, const std::filesystem::path& out) {
  const auto now = read_stage_record(out);
  if (!now || earlier.stage != now->stage) {
    return;
  }
  for (const auto& [name, state] : earlier.artefacts.items()) {
    const std::filesystem::path file = out / name;
    if (!now->artefacts.contains(name) && std::filesystem::is_regular_file(file) &&
        sha256_of_file(file) == state.value("sha256", "")) {
      std::filesystem::remove(file);
    }
  }
}

}  // namespace

void run_single_stage(StageId stage, const std::filesystem::path& out, const Settings& settings,
                      const std::function<StageReport(const std::filesystem::path& folder, const Progress&)>& work) {
  Console console(settings.quiet, settings.verbose);
  const std::optional<StageRecord> earlier = earlier_record(stage, out);
  if (!earlier) {
    refuse_before_work(stage, out);
  }
  console.started(stage);
  StageFolder folder(out, *settings.interruption);
  reset_peak_memory();
  const Stopwatch time;
  const StageReport report =
      work(folder.path(), [&](double fraction, std::string_view what) { console.progress(stage, fraction, what); });
  const double seconds = time.seconds();
  write_stage_record(folder.path(), record_of(stage, "", report, seconds));
  if (!earlier) {
    folder.refuse_others_files();
  }
  folder.merge();
  if (earlier) {
    remove_left_over(*earlier, out);
  }
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
