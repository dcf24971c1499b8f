// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/stat.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <memory>
#include <optional>
#include <utility>

#include "pipelines/commands/commands.hpp"
#include "pipelines/commands/console.hpp"
#include "pipelines/commands/file_watch.hpp"
#include "pipelines/commands/printable.hpp"
#include "pipelines/runner/live_run.hpp"
#include "segmentation/files/refuse.hpp"

namespace brainshift::pipelines {
namespace {

namespace fs = std::filesystem;

struct LiveArguments {
  fs::path run;
  fs::path load;
  bool image = false;
  std::optional<solve::Device> device;
};

double now() {
  timespec time{};
  clock_gettime(CLOCK_REALTIME, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// When a file, or a link to it, was last written, renamed or moved to its place, s; now where it is gone.
double changed_at(const std::filesystem::path& file) {
  struct stat state {};
  struct stat link {};
  if (::stat(file.c_str(), &state) != 0 || ::lstat(file.c_str(), &link) != 0) {
    return now();
  }
  const auto seconds = [](const timespec& time) {
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  return std::max(seconds(state.st_ctim), seconds(link.st_ctim));
}

/// A load that cannot be answered is told and passed over: the next one may be right.
/// told: the warnings of the answer before, which are not repeated.
void answer_next(LiveRun& run, FileWatch& watch, const LiveArguments& arguments, bool quiet, Warnings& told) {
  try {
    watch.next();
    const double changed = changed_at(arguments.load);
    const std::string cut = want_of_newline(arguments.load);
    const LiveRun::Answer answer = run.answer(arguments.load);
    if (!quiet) {
      std::printf("%s: %.3f s after the file's change, largest displacement %.3f mm, error bound %.4f mm\n",
                  printable(answer.folder.string()).c_str(), now() - changed, answer.largest_displacement,
                  answer.error_bound);
      std::fflush(stdout);
    }
    if (!answer.device_fault.empty()) {
      std::fprintf(stderr, "brainshift: from now on the processor answers: %s\n",
                   printable(answer.device_fault).c_str());
    }
    if (arguments.image) {
      run.warp_image();
    }
    const Warnings before = std::exchange(told, run.warnings());
    if (!cut.empty()) {
      told.push_back(cut);
    }
    for (const std::string& warning : told) {
      if (std::ranges::find(before, warning) == before.end()) {
        std::fprintf(stderr, "brainshift: warning: %s\n", printable(warning).c_str());
      }
    }
  } catch (const std::invalid_argument& fault) {
    std::fprintf(stderr, "brainshift: passed over: %s\n", printable(fault.what()).c_str());
  } catch (const std::runtime_error& fault) {
    std::fprintf(stderr, "brainshift: passed over: %s\n", printable(fault.what()).c_str());
  }
}

LiveRun prepared(const LiveArguments& arguments, const Settings& settings) {
  Console console(settings.quiet, settings.verbose);
  return {arguments.run, arguments.image, arguments.device, *settings.interruption,
          [&](double fraction, std::string_view what) { console.progress(StageId::solve, fraction, what); }};
}

/// Until the program is interrupted.
[[noreturn]] void answer_all(const LiveArguments& arguments, const Settings& settings) {
  std::error_code unknown;
  if (fs::is_directory(arguments.load, unknown)) {
    refuse(arguments.load, "is a folder; give the file in it that is going to hold the load");
  }
  LiveRun run = prepared(arguments, settings);
  if (!run.not_kept().empty()) {
    std::fprintf(stderr, "brainshift: the next start prepares the run again: %s\n", printable(run.not_kept()).c_str());
  }
  FileWatch watch(arguments.load);
  if (const fs::path folder = fs::absolute(arguments.load).parent_path(); !fs::is_directory(folder, unknown)) {
    std::fprintf(stderr, "brainshift: warning: %s is not there yet; is the path right?\n",
                 printable(folder.string()).c_str());
  }
  if (!settings.quiet) {
    std::printf("watching %s; Ctrl-C ends it\n", printable(arguments.load.string()).c_str());
    std::fflush(stdout);
  }
  for (Warnings told;;) {
    answer_next(run, watch, arguments, settings.quiet, told);
  }
}

}  // namespace

void add_live_command(CLI::App& program, const Settings& settings) {
  CLI::App* command = program.add_subcommand(
      "live", "Keeps a finished run in memory and answers a load file with transforms whenever it changes.");
  auto arguments = std::make_shared<LiveArguments>();
  command->add_option("run_folder", arguments->run, "the --out of a run")->required()->type_name("RUN");
  command
      ->add_option("--load", arguments->load,
                   "new displacements in the same opening, as craniotomy.csv; may come later")
      ->required()
      ->type_name("FILE");
  add_device_option(*command, arguments->device);
  command->add_flag("--image", arguments->image, "warp the T1, too, after the transforms");
  command->callback([arguments, &settings] { answer_all(*arguments, settings); });
}

}  // namespace brainshift::pipelines
