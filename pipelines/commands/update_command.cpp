// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <optional>
#include <utility>

#include "pipelines/commands/commands.hpp"
#include "pipelines/commands/console.hpp"
#include "pipelines/commands/file_watch.hpp"
#include "pipelines/runner/own_folder.hpp"
#include "pipelines/runner/stage_folder.hpp"
#include "pipelines/runner/stage_record.hpp"
#include "pipelines/runner/update_run.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/progress/stopwatch.hpp"

namespace brainshift::pipelines {
namespace {

namespace fs = std::filesystem;

struct UpdateArguments {
  fs::path run;
  fs::path load;
  fs::path out;
  std::optional<solve::Device> device;
};

/// RUN/update/NAME of the load's file NAME.csv, where no other folder is named.
fs::path out_of(const UpdateArguments& arguments) {
  const fs::path out = arguments.out.empty() ? arguments.run / "update" / arguments.load.stem() : arguments.out;
  if (fs::exists(out / "run.json")) {
    refuse(out, "this is a run, of which nothing is written over; choose another folder with --out");
  }
  return out;
}

/// Answers the load into a folder that appears when it is whole.
StageReport answer(UpdatedRun& run, const fs::path& load, const fs::path& out, const Stopwatch& time,
                   Interruption& interruption, const Progress& progress) {
  const std::string cut = want_of_newline(load);
  StageFolder folder(out, interruption);
  StageReport report = run.answer(load, folder.path(), progress);
  if (!cut.empty()) {
    report.notes.push_back("warning: " + cut);
  }
  write_stage_record(folder.path(), record_of(StageId::solve, "", report, time.seconds()));
  folder.replace();
  return report;
}

/// The same; a fault leaves no empty folder above it.
StageReport answer_or_nothing(UpdatedRun& run, const fs::path& load, const fs::path& out, const Stopwatch& time,
                              Interruption& interruption, const Progress& progress) {
  const bool was_there = fs::exists(out.parent_path());
  try {
    return answer(run, load, out, time, interruption, progress);
  } catch (...) {
    std::error_code ignored;
    if (!was_there) {
      fs::remove(out.parent_path(), ignored);
    }
    throw;
  }
}

void update(const UpdateArguments& arguments, const Settings& settings) {
  Console console(settings.quiet, settings.verbose);
  bool to_begin = !arguments.load.empty();
  const Progress progress = [&](double fraction, std::string_view what) {
    if (std::exchange(to_begin, false)) {  // only now, as what cannot be updated is refused before
      console.started(StageId::solve);
    }
    console.progress(StageId::solve, fraction, what);
  };
  const Stopwatch time;
  if (arguments.load.empty()) {
    if (const UpdatedRun prepared(arguments.run, *settings.interruption, progress); !prepared.not_kept().empty()) {
      throw std::runtime_error(prepared.not_kept());
    }
    return;
  }
  const fs::path out = out_of(arguments) / stage_name(StageId::solve);
  UpdatedRun run(arguments.run, *settings.interruption, progress, arguments.device);
  refuse_foreign_folder(out);
  refuse_foreign_folder(old_of(out));
  const StageReport report = answer_or_nothing(run, arguments.load, out, time, *settings.interruption, progress);
  const double seconds = time.seconds();
  for (const std::string& note : report.notes) {
    console.note(StageId::solve, note);
  }
  if (!report.failure.empty()) {
    console.failed(StageId::solve);
    throw NotConverged(report.failure);
  }
  console.finished(StageId::solve, seconds);
}

}  // namespace

void add_update_command(CLI::App& program, const Settings& settings) {
  CLI::App* command = program.add_subcommand("update", "Solves a finished run under a new load, from its last state.");
  auto arguments = std::make_shared<UpdateArguments>();
  command->add_option("run_folder", arguments->run, "the --out of a run")->required()->type_name("RUN");
  CLI::Option* load =
      command
          ->add_option(
              "--load", arguments->load,
              "new displacements in the same opening, as craniotomy.csv; absent: only prepare the run for them")
          ->type_name("FILE");
  add_device_option(*command, arguments->device)->needs(load);
  command->add_option("--out", arguments->out, "folder for solve/; RUN/update/NAME of NAME.csv if absent")
      ->type_name("DIR")
      ->needs(load);
  command->callback([arguments, &settings] { update(*arguments, settings); });
}

}  // namespace brainshift::pipelines
