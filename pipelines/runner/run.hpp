// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "pipelines/runner/run_stages.hpp"

namespace brainshift::pipelines {

/// Runs a checked scene: segment, discretise, solve, register, report, each in its folder under `out`, kept where its
/// inputs' contents, options and the program's version are those of the time it was made and its files are whole.
/// run.json is written after each stage. A stage without the files that it needs (register and report without a T1 or
/// labels) is left out. A stage that does not converge ends the run; what it has is kept. Throws std::invalid_argument
/// where the input is at fault and std::runtime_error where writing is, naming the file; stages that were finished are
/// kept, the unfinished one leaves nothing.
///
/// Of a sequence each state is such a run, in state_folder(), and goes on from the one before; run.json under `out`
/// holds the stages of all, and steps.pvd plays them.
RunOutcome run(const Scene& scene, const RunOptions& options, Interruption& interruption,
               const RunObserver& observer = {});

/// out/states/NAME
std::filesystem::path state_folder(const std::filesystem::path& out, const std::string& state);

}  // namespace brainshift::pipelines
