// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "pipelines/runner/interruption.hpp"
#include "pipelines/scene/scene.hpp"

namespace brainshift::pipelines {

struct RunOptions {
  std::filesystem::path out;
  StageId until = StageId::report;  ///< the last stage to run
  bool force = false;               ///< run stages that have not changed, too
};

/// What happens in a run, for whoever shows it.
struct RunEvent {
  enum class Kind : std::uint8_t { started, progress, note, finished, kept, failed } kind;
  StageId stage;
  double fraction = 0;        ///< of the stage, 0 to 1
  double total_fraction = 0;  ///< of the run's expected time, 0 to 1
  std::string_view what;      ///< what is being done; of a kept stage: the files that were edited since;
                              ///< of a note: its sentence
  double seconds = 0;         ///< that the stage took, when it is finished
};
using RunObserver = std::function<void(const RunEvent&)>;

struct RunOutcome {
  nlohmann::ordered_json record;  ///< run.json
  std::string failure;            ///< empty, or the sentence of a stage that did not converge
};

/// Runs a checked scene: segment, discretise, solve, register, report, each in its folder under `out`, kept where its
/// inputs' contents, options and the program's version are those of the time it was made and its files are whole.
/// run.json is written after each stage. A stage without the files that it needs (register and report without a T1 or
/// labels) is left out. A stage that does not converge ends the run; what it has is kept. Throws std::invalid_argument
/// where the input is at fault and std::runtime_error where writing is, naming the file; stages that were finished are
/// kept, the unfinished one leaves nothing.
RunOutcome run(const Scene& scene, const RunOptions& options, Interruption& interruption,
               const RunObserver& observer = {});

}  // namespace brainshift::pipelines
