// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>

#include "pipelines/commands/commands.hpp"
#include "pipelines/commands/console.hpp"
#include "pipelines/runner/peak_memory.hpp"
#include "pipelines/runner/stage_folder.hpp"
#include "pipelines/runner/stage_record.hpp"

namespace brainshift::pipelines {

void run_single_stage(StageId stage, const std::filesystem::path& out, const Settings& settings,
                      const std::function<StageReport(const std::filesystem::path& folder, const Progress&)>& work) {
  Console console(settings.quiet, settings.verbose);
  console.started(stage);
  StageFolder folder(out, *settings.interruption);
  reset_peak_memory();
  const auto begin = std::chrono::steady_clock::now();
  const StageReport report =
      work(folder.path(), [&](double fraction, std::string_view what) { console.progress(stage, fraction, what); });
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  write_stage_record(folder.path(),
                     {.stamp = "", .failure = report.failure, .entry = stage_entry(report, seconds, peak_memory_mb())});
  folder.merge();
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
