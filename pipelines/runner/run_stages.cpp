// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/run_stages.hpp"

#include "pipelines/runner/artefacts.hpp"
#include "pipelines/runner/enough_memory.hpp"
#include "pipelines/runner/folder_lock.hpp"
#include "pipelines/runner/own_folder.hpp"
#include "pipelines/runner/peak_memory.hpp"
#include "pipelines/runner/plan.hpp"
#include "pipelines/runner/require_gpu.hpp"
#include "pipelines/runner/run_record.hpp"
#include "pipelines/runner/stage_folder.hpp"
#include "pipelines/runner/stage_record.hpp"
#include "pipelines/show/show_scripts.hpp"
#include "segmentation/options/values.hpp"
#include "segmentation/progress/stopwatch.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

/// The shares of the stages in the time of a run, measured on a head of 12,000 nodes: for the estimate of what is left.
constexpr std::array<double, all_stages.size()> time_shares = {0.11, 0.04, 0.26, 0.53, 0.06};

/// Where the run stands, and telling it to the observer.
class Tally {
 public:
  Tally(const Scene& scene, StageId until, const RunObserver& observer) : observer_(observer) {
    for (const StageId stage : all_stages) {
      whole_ += stage <= until && is_active(stage, scene) ? time_shares[index_of(stage)] : 0;
    }
  }
  void tell(RunEvent::Kind kind, StageId stage, double fraction = 0, std::string_view what = {}, double seconds = 0) {
    if (observer_) {
      observer_({kind, stage, fraction, (done_ + fraction * time_shares[index_of(stage)]) / whole_, what, seconds});
    }
  }
  /// The notes of the stage's entry, of a kept stage too: what they say still holds.
  void tell_notes(StageId stage, const nlohmann::ordered_json& entry) {
    if (const auto notes = entry.find("notes"); notes != entry.end() && notes->is_array()) {
      for (const auto& note : *notes) {
        tell(RunEvent::Kind::note, stage, 1, note.is_string() ? note.get<std::string>() : "");
      }
    }
  }
  void finish(StageId stage) { done_ += time_shares[index_of(stage)]; }

 private:
  const RunObserver& observer_;
  double whole_ = 0;
  double done_ = 0;
};

/// What lies in the folder where that is what the plan would make, maybe edited since; else nothing.
struct Kept {
  StageRecord record;
  std::vector<std::string> edited;
};
std::optional<Kept> kept(const StagePlan& plan, const std::string& plan_stamp, const fs::path& folder) {
  const auto record = read_stage_record(folder);
  if (!record || record->stamp != plan_stamp || !record->failure.empty()) {
    return std::nullopt;
  }
  for (const std::string& name : plan.artefacts) {
    if (!record->artefacts.contains(name)) {
      return std::nullopt;
    }
  }
  ArtefactChanges changes = changes_of(record->artefacts, folder);
  return changes.lost.empty() ? std::optional(Kept{*record, std::move(changes.edited)}) : std::nullopt;
}

/// Links a stage to that of the run before, where it is the same; true when it did. Solutions and images differ from
/// state to state in any case.
bool take_over(const StagePlan& plan, const std::string& plan_stamp, const fs::path& before, const fs::path& folder) {
  if (fs::is_symlink(folder)) {
    fs::remove(folder);
  }
  const fs::path other = before / folder.filename();
  if (before.empty() || plan.stage > StageId::discretise || !kept(plan, plan_stamp, other)) {
    return false;
  }
  refuse_foreign_folder(folder);
  remove_own_folder(folder);
  std::error_code refused;  // by a file system without links, where the stage runs again
  fs::create_directory_symlink(
      fs::is_symlink(other) ? fs::read_symlink(other) : fs::path("..") / before.filename() / folder.filename(), folder,
      refused);
  return !refused;
}

StageRecord make_stage(const StagePlan& plan, const fs::path& folder, InputStates& states, Interruption& interruption,
                       const Progress& progress) {
  refuse_foreign_folder(folder);
  refuse_foreign_folder(old_of(folder));
  StageFolder unfinished(folder, interruption);
  reset_peak_memory();
  const Stopwatch time;
  const StageReport report = plan.work(unfinished.path(), progress);
  const double seconds = time.seconds();
  for (const InputFile& input : plan.inputs) {
    states.check_unchanged(input.path);
  }
  const StageRecord record = record_of(plan.stage, stamp(plan, states), report, seconds);
  write_stage_record(unfinished.path(), record);
  unfinished.replace();
  return record;
}

/// Makes a stage and tells how it goes.
StageRecord make_told(const StagePlan& plan, const fs::path& folder, InputStates& states, Interruption& interruption,
                      Tally& tally) {
  tally.tell(RunEvent::Kind::started, plan.stage);
  const Progress progress = [&](double fraction, std::string_view what) {
    tally.tell(RunEvent::Kind::progress, plan.stage, fraction, what);
  };
  StageRecord record = make_stage(plan, folder, states, interruption, progress);
  tally.tell_notes(plan.stage, record.entry);
  const auto kind = record.failure.empty() ? RunEvent::Kind::finished : RunEvent::Kind::failed;
  tally.tell(kind, plan.stage, 1, {}, record.entry["seconds"]);
  return record;
}

/// What the record says of a stage that is kept.
nlohmann::ordered_json entry_of(const Kept& kept) {
  nlohmann::ordered_json entry = kept.record.entry;
  entry["status"] = "kept";
  if (!kept.edited.empty()) {
    if (!entry.contains("notes") || !entry["notes"].is_array()) {
      entry["notes"] = nlohmann::ordered_json::array();
    }
    entry["notes"].push_back("warning: not as this stage made it: " + with_commas(kept.edited) +
                             "; the stage's figures and checks are of what it made");
  }
  return entry;
}

/// Whoever may read a script may start it.
void make_executable(const fs::path& script) {
  constexpr fs::perms all_read = fs::perms::owner_read | fs::perms::group_read | fs::perms::others_read;
  std::error_code refused;  // by a file system without rights, where nothing is started by a double-click
  const auto readers = static_cast<unsigned>(fs::status(script, refused).permissions() & all_read);
  fs::permissions(script, static_cast<fs::perms>(readers >> 2), fs::perm_options::add, refused);
}

/// For whoever opens the folder: whatever ran, they show what lies there.
void write_scripts(const fs::path& out, Interruption& interruption) {
  const auto hold = interruption.hold();
  for (const ShowScript& script : show_scripts()) {
    write_whole(out / script.name, script.text);
    make_executable(out / script.name);
  }
}

/// Later stages of an earlier run that were not reached: told apart from those that still hold.
void note_unreached(nlohmann::ordered_json& stages, const Scene& scene, const fs::path& out, StageId last,
                    InputStates& states, Interruption& interruption) {
  bool outdated = false;  // and then so is all that was made from it
  for (const StageId stage : all_stages) {
    const fs::path folder = out / stage_name(stage);
    if (stage <= last) {
      continue;
    }
    if (const auto record = read_stage_record(folder)) {
      const StagePlan plan = plan_stage(stage, scene, out, interruption);
      auto& entry = stages[std::string(stage_name(stage))] = record->entry;
      outdated = outdated || !kept(plan, stamp(plan, states), folder);
      if (outdated) {
        entry["status"] = "outdated";
      }
    }
  }
}

}  // namespace

RunOutcome run_stages(const Scene& scene, const RunOptions& options, const fs::path& before, Interruption& interruption,
                      const RunObserver& observer) {
  const fs::path out = place_of(options.out);
  const FolderLock lock(out);
  InputStates states;
  RunOutcome outcome{begin_run_record(scene, states), {}};
  Tally tally(scene, options.until, observer);
  bool machine_is_enough = false;
  StageId last = StageId::segment;
  for (const StageId stage : all_stages) {
    if (stage > options.until || !outcome.failure.empty()) {
      break;
    }
    last = stage;
    const std::string name(stage_name(stage));
    if (!is_active(stage, scene)) {
      outcome.record["stages"][name] = {{"status", "inactive"}};
      continue;
    }
    const StagePlan plan = plan_stage(stage, scene, out, interruption);
    const std::string plan_stamp = stamp(plan, states);
    const bool taken = take_over(plan, plan_stamp, before, out / name);
    const std::optional<Kept> old = options.force && !taken ? std::nullopt : kept(plan, plan_stamp, out / name);
    if (old) {
      outcome.record["stages"][name] = entry_of(*old);
      tally.tell(RunEvent::Kind::kept, stage, 0, with_commas(old->edited));
      tally.tell_notes(stage, old->record.entry);
    } else {
      if (!machine_is_enough) {
        require_gpu(scene, stage, options.until);
        require_memory(scene, stage, options.until, available_memory_mb());
        machine_is_enough = true;
      }
      const StageRecord record = make_told(plan, out / name, states, interruption, tally);
      outcome.record["stages"][name] = record.entry;
      outcome.failure = record.failure;
    }
    tally.finish(stage);
    write_run_record(out, outcome.record, interruption);
  }
  note_unreached(outcome.record["stages"], scene, out, last, states, interruption);
  write_run_record(out, outcome.record, interruption);
  write_scripts(out, interruption);
  return outcome;
}

}  // namespace brainshift::pipelines
