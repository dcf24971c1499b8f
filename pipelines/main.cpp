// SPDX-License-Identifier: GPL-3.0-or-later
//
// brainshift: a labelled head MRI and the displacements measured on the exposed cortex go in; the preoperative image,
// warped to the intraoperative brain, comes out.
//
//   brainshift phantom --out head            a synthetic head, its load and its scene
//   brainshift run head/scene.xml --out run  all stages, to run/report/index.html
//   brainshift COMMAND --help
//
// Exit codes: 0 done, 1 a fault of ours (a full disk too), 2 the input's fault, 3 the computation did not converge,
// 128 + signal when interrupted.
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "pipelines/commands/commands.hpp"
#include "pipelines/commands/printable.hpp"
#include "pipelines/runner/libraries.hpp"
#include "pipelines/runner/processors.hpp"

using namespace brainshift::pipelines;

namespace {

constexpr int most_threads = 1024;

int say(int exit_code, const std::string& what) {
  std::fprintf(stderr, "brainshift: %s\n", printable(what).c_str());
  return exit_code;
}

/// The exit code of what is being thrown, which it tells.
int tell_fault() {
  try {
    throw;
  } catch (const NotConverged& error) {
    return say(3, error.what());
  } catch (const std::invalid_argument& error) {
    return say(2, error.what());
  } catch (const std::bad_alloc&) {
    return say(1, "there is not enough memory; use fewer nodes or a smaller image");
  } catch (const std::filesystem::filesystem_error& error) {
    return say(1, error.path1().string() + ": cannot be reached (" + error.code().message() +
                      "); check the path, the disk and your rights");
  } catch (const std::system_error& error) {
    return say(1, "the system refuses a thread (" + error.code().message() +
                      "); allow more memory or processes, or set --threads 1");
  } catch (const std::runtime_error& error) {
    return say(1, error.what());
  } catch (...) {
    return say(1, "a library failed in a way that is not foreseen; please report it with the command and its files");
  }
}

/// What nobody can catch: an exception in a thread of OpenMP, a crash in a library that did not see that its memory was
/// refused. It ends as a fault of ours; the next run removes what it leaves.
[[noreturn]] void leave_crashed(int) {
  constexpr std::string_view what =
      "brainshift: a library broke down, most often for want of memory: use fewer nodes, a smaller image or fewer "
      "threads; where there is enough, please report the command and its files\n";
  const auto written = write(STDERR_FILENO, what.data(), what.size());
  _exit(written < 0 ? EXIT_FAILURE : 1);
}

void end_well_when_crashing() {
  std::set_terminate([] { leave_crashed(SIGABRT); });
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
    std::signal(signal, leave_crashed);
  }
}

[[noreturn]] void leave_interrupted(int signal) {
  say(0, "interrupted; what was finished is kept, and a run goes on from it with the same command");
  _exit(128 + signal);
}

void add_settings(CLI::App& program, Settings& settings) {
  program.add_flag("-q,--quiet", settings.quiet, "say nothing but errors");
  program.add_flag("-v,--verbose", settings.verbose, "say what each stage is doing");
  program
      .add_option_function<int>(
          "--threads", [](int threads) { set_threads(threads); }, "threads to use; results do not depend on it")
      ->check(CLI::Range(1, most_threads))
      ->type_name("N")
      ->trigger_on_parse();
  program.set_version_flag("--version", "brainshift " BRAINSHIFT_VERSION);
  program.require_subcommand(1);
  program.fallthrough();
}

/// CLI11 would say that a subcommand is required.
std::string fault_of(const CLI::App& program, const CLI::ParseError& error) {
  const std::vector<std::string> unknown = program.remaining();
  if (error.get_name() != "RequiredError" || !program.get_subcommands().empty()) {
    return error.what();
  }
  return (unknown.empty() ? "a command is needed" : "there is no command '" + unknown.front() + "'") +
         "; 'brainshift --help' lists the commands";
}

int run_program(int argc, char** argv) {
  CLI::App program("From a head MRI and measured displacements to a warped image.", "brainshift");
  Interruption interruption(leave_interrupted);
  set_threads(std::getenv("OMP_NUM_THREADS") == nullptr ? available_threads()
                                                        : std::min(threads_in_use(), most_threads));
  Settings settings;
  settings.interruption = &interruption;
  add_settings(program, settings);
  add_run_command(program, settings);
  add_segment_command(program, settings);
  add_discretise_command(program, settings);
  add_solve_command(program, settings);
  add_register_command(program, settings);
  add_warp_command(program, settings);
  add_update_command(program, settings);
  add_live_command(program, settings);
  add_report_command(program, settings);
  add_phantom_command(program, settings);
  add_scene_command(program, settings);
  add_slicer_command(program, settings);
  add_tradeoff_command(program, settings);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return error.get_exit_code() == 0 ? program.exit(error) : say(2, fault_of(program, error));
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  // A limit on the size of files is then a failed write like a full disk, not a killed program.
  std::signal(SIGXFSZ, SIG_IGN);
  // So is a reader of our output that has gone away.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGCHLD, SIG_DFL);  // who started the program may ignore the end of its children
  end_well_when_crashing();
  take_short_turns();
  silence_libraries();
  try {
    return run_program(argc, argv);
  } catch (...) {
    return tell_fault();
  }
}
