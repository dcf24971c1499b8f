// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
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
  double fraction = 0;          ///< of the stage, 0 to 1
  double total_fraction = 0;    ///< of the run's expected time, 0 to 1
  std::string_view what;        ///< what is being done; of a kept stage: the files that were edited since;
                                ///< of a note: its sentence
  double seconds = 0;           ///< that the stage took, when it is finished
  std::string_view state = {};  ///< of a sequence
};
using RunObserver = std::function<void(const RunEvent&)>;

struct RunOutcome {
  nlohmann::ordered_json record;  ///< run.json
  std::string failure;            ///< empty, or the sentence of a stage that did not converge
};

/// Runs a checked scene without a sequence, as run() does. before: the folder of a run whose segment and discretise
/// stages are taken over, by links, where this one would make the same; empty: none.
RunOutcome run_stages(const Scene& scene, const RunOptions& options, const std::filesystem::path& before,
                      Interruption& interruption, const RunObserver& observer);

}  // namespace brainshift::pipelines
