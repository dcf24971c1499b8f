// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/run.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>

#include "pipelines/runner/peak_memory.hpp"
#include "pipelines/runner/plan.hpp"
#include "pipelines/runner/run_record.hpp"
#include "pipelines/runner/stage_folder.hpp"
#include "segmentation/files/make_folder.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

/// The shares of the stages in the time of a run, measured on a head of 12,000 nodes: for the estimate of what is left.
constexpr std::array<double, all_stages.size()> time_shares = {0.11, 0.04, 0.26, 0.53, 0.06};

/// Two runs in one folder would tear each other's files apart.
class FolderLock {
 public:
  explicit FolderLock(const fs::path& folder) : file_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (file_ < 0 || flock(file_, LOCK_EX | LOCK_NB) != 0) {
      const bool busy = file_ >= 0;
      close(file_);
      throw std::runtime_error(folder.string() +
                               (busy ? ": another run is working in this folder; wait for it or choose "
                                       "another --out"
                                     : ": this folder cannot be opened"));
    }
  }
  ~FolderLock() { close(file_); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
};

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
  void finish(StageId stage) { done_ += time_shares[index_of(stage)]; }

 private:
  const RunObserver& observer_;
  double whole_ = 0;
  double done_ = 0;
};

/// Whether what lies in the folder is what the plan would make.
bool is_current(const StagePlan& plan, const std::string& plan_stamp, const fs::path& folder) {
  const auto record = read_stage_record(folder);
  if (!record || record->stamp != plan_stamp || !record->failure.empty()) {
    return false;
  }
  for (const std::string& name : plan.artefacts) {
    if (!fs::exists(folder / name)) {
      return false;
    }
  }
  return true;
}

void refuse_foreign_folder(const fs::path& folder) {
  if (fs::exists(folder) && !fs::exists(folder / "stage.json")) {
    throw std::invalid_argument(folder.string() +
                                ": this was not made by brainshift and would be overwritten; move it "
                                "away or choose another --out");
  }
}

StageRecord make_stage(const StagePlan& plan, const std::string& plan_stamp, const fs::path& folder,
                       Interruption& interruption, const Progress& progress) {
  refuse_foreign_folder(folder);
  StageFolder unfinished(folder, interruption);
  reset_peak_memory();
  const auto begin = std::chrono::steady_clock::now();
  const StageReport report = plan.work(unfinished.path(), progress);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  const StageRecord record{plan_stamp, report.failure, stage_entry(report, seconds.count(), peak_memory_mb())};
  write_stage_record(unfinished.path(), record);
  unfinished.replace();
  return record;
}

/// Later stages of an earlier run that were not reached: told apart from those that still hold.
void note_unreached(nlohmann::ordered_json& stages, const Scene& scene, const fs::path& out, StageId last,
                    Interruption& interruption) {
  bool outdated = false;  // and then so is all that was made from it
  for (const StageId stage : all_stages) {
    const fs::path folder = out / stage_name(stage);
    if (stage <= last) {
      continue;
    }
    if (const auto record = read_stage_record(folder)) {
      const StagePlan plan = plan_stage(stage, scene, out, interruption);
      auto& entry = stages[std::string(stage_name(stage))] = record->entry;
      outdated = outdated || !is_current(plan, stamp(plan), folder);
      if (outdated) {
        entry["status"] = "outdated";
      }
    }
  }
}

}  // namespace

RunOutcome run(const Scene& scene, const RunOptions& options, Interruption& interruption, const RunObserver& observer) {
  const fs::path out = fs::absolute(options.out).lexically_normal();
  make_folder(out);
  const FolderLock lock(out);
  RunOutcome outcome{begin_run_record(scene), {}};
  Tally tally(scene, options.until, observer);
  bool rerun = options.force;
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
    const std::string plan_stamp = stamp(plan);
    if (!rerun && is_current(plan, plan_stamp, out / name)) {
      outcome.record["stages"][name] = read_stage_record(out / name)->entry;
      outcome.record["stages"][name]["status"] = "kept";
      tally.tell(RunEvent::Kind::kept, stage);
    } else {
      tally.tell(RunEvent::Kind::started, stage);
      const Progress progress = [&](double fraction, std::string_view what) {
        tally.tell(RunEvent::Kind::progress, stage, fraction, what);
      };
      const StageRecord record = make_stage(plan, plan_stamp, out / name, interruption, progress);
      outcome.record["stages"][name] = record.entry;
      outcome.failure = record.failure;
      for (const auto& note : record.entry.value("notes", std::vector<std::string>{})) {
        tally.tell(RunEvent::Kind::note, stage, 1, note);
      }
      const auto kind = record.failure.empty() ? RunEvent::Kind::finished : RunEvent::Kind::failed;
      tally.tell(kind, stage, 1, {}, record.entry["seconds"]);
    }
    tally.finish(stage);
    write_whole(out / "run.json", outcome.record.dump(2) + "\n");
  }
  note_unreached(outcome.record["stages"], scene, out, last, interruption);
  write_whole(out / "run.json", outcome.record.dump(2) + "\n");
  return outcome;
}

}  // namespace brainshift::pipelines
