// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/phantoms/heads/head_runs.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "tests/phantoms/program.hpp"

namespace brainshift {

namespace {

using pipelines::PhantomFrame;

HeadRun make_run(const std::string& name, PhantomFrame frame, const std::string& more) {
  static const ScratchFolder scratch;
  const pipelines::PhantomOptions options{.size = 44, .spacing = 4.0, .frame = frame};
  const std::filesystem::path head = scratch / (name + "_head");
  const std::filesystem::path folder = scratch / name;
  pipelines::write_phantom(options, head);
  const ProgramResult result =
      run_shell("brainshift run " + (head / "scene.xml").string() + " --out " + folder.string() + " " + more);
  if (result.code != 0) {
    throw std::runtime_error("the run ended with " + std::to_string(result.code) + ": " + result.err);
  }
  return {folder, pipelines::make_phantom(options), nlohmann::json::parse(bytes_of(folder / "run.json"))};
}

}  // namespace

double HeadRun::measure(const std::string& stage, const std::string& name) const {
  const nlohmann::json::json_pointer place("/stages/" + stage + "/measures/" + name);
  if (!record.contains(place)) {
    ADD_FAILURE() << "run.json has no " << place;
    return std::numeric_limits<double>::quiet_NaN();
  }
  return record.at(place).get<double>();
}

const HeadRun& oblique_run() {
  static const HeadRun run = make_run("oblique", PhantomFrame::oblique, "--threads 2");
  return run;
}

const HeadRun& mirrored_run() {
  static const HeadRun run = make_run("mirrored", PhantomFrame::mirrored, "--threads 2");
  return run;
}

const HeadRun& one_thread_run() {
  static const HeadRun run = make_run("one_thread", PhantomFrame::oblique, "--threads 1 --until solve");
  return run;
}

}  // namespace brainshift
