// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace brainshift::pipelines {

/// run.json of a run's folder; no object (is_object()) where there is none that can be read.
nlohmann::ordered_json read_run_record(const std::filesystem::path& run);

/// Whether a file among a record's inputs holds what it held when the run was made. Throws std::invalid_argument,
/// naming the file, when it cannot be read.
bool is_unchanged(const nlohmann::ordered_json& input);

}  // namespace brainshift::pipelines
