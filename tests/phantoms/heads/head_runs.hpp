// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "pipelines/phantom/phantom.hpp"

namespace brainshift {

/// A finished run of a small synthetic head.
struct HeadRun {
  std::filesystem::path folder;
  pipelines::Phantom phantom;
  nlohmann::json record;  ///< run.json

  /// A number of a stage's measures; fails the test and gives NaN where there is none.
  double measure(const std::string& stage, const std::string& name) const;
};

/// The head in the oblique frame, run whole with two threads. Made once, on the first call; throws where the run fails.
const HeadRun& oblique_run();

/// The same head in a left-handed frame.
const HeadRun& mirrored_run();

/// The oblique head once more, with one thread, up to the solve stage.
const HeadRun& one_thread_run();

}  // namespace brainshift
