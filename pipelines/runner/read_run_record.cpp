// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/read_run_record.hpp"

#include <fstream>

namespace brainshift::pipelines {

nlohmann::ordered_json read_run_record(const std::filesystem::path& run) {
  std::ifstream stream(run / "run.json");
  return nlohmann::ordered_json::parse(stream, nullptr, false);
}

}  // namespace brainshift::pipelines
