// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/stat.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include "pipelines/commands/commands.hpp"
#include "pipelines/commands/console.hpp"
#include "pipelines/commands/printable.hpp"
#include "pipelines/runner/live_run.hpp"

namespace brainshift::pipelines {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds pause{5};  // between looks at the file
constexpr std::chrono::milliseconds rest{20};  // unchanged for so long, it is whole

struct LiveArguments {
  fs::path run;
  fs::path load;
  bool image = false;
};

/// What changes when a file is written.
struct FileState {
  bool there = false;
  ino_t file = 0;
  off_t size = 0;
  time_t second = 0;
  long nanosecond = 0;

  bool operator==(const FileState&) const = default;
};

FileState state_of(const fs::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) {
    return {};
  }
  return {true, status.st_ino, status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

/// Seconds from a file's last change until now.
double age_of(const FileState& state) {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  return static_cast<double>(now.tv_sec - state.second) + 1e-9 * static_cast<double>(now.tv_nsec - state.nanosecond);
}

/// A load that cannot be answered is told and passed over: the next one may be right.
void answer(LiveRun& run, const LiveArguments& arguments, const FileState& state, bool quiet) {
  try {
    const LiveRun::Answer answer = run.answer(arguments.load);
    if (!quiet) {
      std::printf("%s: %.3f s after the file's change, largest displacement %.3f mm, error bound %.4f mm\n",
                  printable(answer.folder.string()).c_str(), age_of(state), answer.largest_displacement,
                  answer.error_bound);
      std::fflush(stdout);
    }
    if (arguments.image) {
      run.warp_image();
    }
  } catch (const std::invalid_argument& fault) {
    std::fprintf(stderr, "brainshift: passed over: %s\n", printable(fault.what()).c_str());
  } catch (const std::runtime_error& fault) {
    std::fprintf(stderr, "brainshift: passed over: %s\n", printable(fault.what()).c_str());
  }
}

/// Until the program is interrupted.
[[noreturn]] void watch(const LiveArguments& arguments, const Settings& settings) {
  Console console(settings.quiet, settings.verbose);
  LiveRun run(arguments.run, arguments.image, *settings.interruption, [&](double fraction, std::string_view what) {
    console.progress(StageId::solve, fraction, fraction, what);
  });
  if (!settings.quiet) {
    std::printf("watching %s; Ctrl-C ends it\n", printable(arguments.load.string()).c_str());
    std::fflush(stdout);
  }
  FileState seen, answered;
  auto since = std::chrono::steady_clock::now();
  for (;; std::this_thread::sleep_for(pause)) {
    const FileState now = state_of(arguments.load);
    if (now != seen) {
      seen = now;
      since = std::chrono::steady_clock::now();
    } else if (now.there && now != answered && std::chrono::steady_clock::now() - since >= rest) {
      answer(run, arguments, now, settings.quiet);
      answered = now;
    }
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
  command->add_flag("--image", arguments->image, "warp the T1, too, after the transforms");
  command->callback([arguments, &settings] { watch(*arguments, settings); });
}

}  // namespace brainshift::pipelines
