// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "pipelines/runner/interruption.hpp"
#include "pipelines/scene/scene.hpp"

namespace brainshift::pipelines {

/// Solves a run once more as it was, and then with each of its optional parts left out or made cheaper in turn
/// (cheaper_models.hpp), and says what that changed at the nodes and saved: measured, not guessed. Nothing is written.
/// scene: checked, that of the run. within: the change that counts as none, mm; absent: the solve stage's tolerance.
/// tell: what is being solved, for whoever waits. Throws std::invalid_argument when the folder is no run, not of this
/// scene, or its solve stage failed or is another program.
std::string explain_after(const Scene& scene, const std::filesystem::path& run, std::optional<double> within,
                          Interruption& interruption, const std::function<void(const std::string&)>& tell);

}  // namespace brainshift::pipelines
