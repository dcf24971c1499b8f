// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace brainshift::pipelines {

/// run.json of a run's folder; no object (is_object()) where there is none that can be read.
nlohmann::ordered_json read_run_record(const std::filesystem::path& run);

}  // namespace brainshift::pipelines
