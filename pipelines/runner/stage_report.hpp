// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace brainshift::pipelines {

/// What a stage says of itself, for run.json (FILES.md lists the fields).
struct StageReport {
  nlohmann::ordered_json sizes = nlohmann::ordered_json::object();
  nlohmann::ordered_json measures = nlohmann::ordered_json::object();
  std::vector<std::string> notes;  ///< sentences for the user: what was recognised or dropped, or is hardly meant
  std::string failure;  ///< empty, or the sentence of a computation that did not converge; its artefacts are written
};

}  // namespace brainshift::pipelines
