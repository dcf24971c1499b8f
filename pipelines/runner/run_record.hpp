// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "pipelines/runner/plan.hpp"

namespace brainshift::pipelines {

/// run.json before any stage: version, scene, inputs with checksums, options, threads.
nlohmann::ordered_json begin_run_record(const Scene& scene, InputStates& states);

/// Writes it as run.json into a run's folder.
void write_run_record(const std::filesystem::path& out, const nlohmann::ordered_json& record,
                      Interruption& interruption);

}  // namespace brainshift::pipelines
