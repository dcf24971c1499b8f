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
#include <new>

#include "pipelines/commands/commands.hpp"
#include "pipelines/runner/libraries.hpp"
#include "pipelines/runner/processors.hpp"

using namespace brainshift::pipelines;

namespace {

constexpr int most_threads = 1024;

int say(int exit_code, const char* what) {
  std::fprintf(stderr, "brainshift: %s\n", what);
  return exit_code;
}

[[noreturn]] void leave_interrupted(int signal) {
  say(0, "interrupted; finished stages are kept, the same command continues from them");
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

int run_program(int argc, char** argv) {
  CLI::App program("From a head MRI and measured displacements to a warped image.", "brainshift");
  Interruption interruption(leave_interrupted);
  Settings settings;
  settings.interruption = &interruption;
  add_settings(program, settings);
  add_run_command(program, settings);
  add_segment_command(program, settings);
  add_discretise_command(program, settings);
  add_solve_command(program, settings);
  add_register_command(program, settings);
  add_report_command(program, settings);
  add_phantom_command(program, settings);
  add_scene_command(program, settings);
  add_tradeoff_command(program, settings);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return error.get_exit_code() == 0 ? program.exit(error) : say(2, error.what());
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  // A limit on file sizes is then a failed write like a full disk, not a killed program.
  std::signal(SIGXFSZ, SIG_IGN);
  wait_asleep(argv);
  silence_libraries();
  set_threads(std::getenv("OMP_NUM_THREADS") == nullptr ? available_threads()
                                                        : std::min(threads_in_use(), most_threads));
  try {
    return run_program(argc, argv);
  } catch (const NotConverged& error) {
    return say(3, error.what());
  } catch (const std::invalid_argument& error) {
    return say(2, error.what());
  } catch (const std::bad_alloc&) {
    return say(1, "there is not enough memory; use fewer nodes or a smaller image");
  } catch (const std::exception& error) {
    return say(1, error.what());
  }
}
