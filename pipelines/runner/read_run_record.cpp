// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/read_run_record.hpp"

#include <fstream>

#include "pipelines/checksum/sha256.hpp"

namespace brainshift::pipelines {

nlohmann::ordered_json read_run_record(const std::filesystem::path& run) {
  std::ifstream stream(run / "run.json");
  return nlohmann::ordered_json::parse(stream, nullptr, false);
}

bool is_unchanged(const nlohmann::ordered_json& input) {
  return input.value("sha256", "") == sha256_of_file(input.value("path", ""));
}

}  // namespace brainshift::pipelines
