// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace brainshift::pipelines {

/// Every file of a stage's folder, and of the folders in it, but the marks of the runner:
/// {"brain.vtp": {"bytes": 1, "sha256": "..."}}.
nlohmann::ordered_json artefacts_in(const std::filesystem::path& folder);

/// What became of the files of a stage's folder since they were recorded.
struct ArtefactChanges {
  std::vector<std::string> edited;  ///< a surface, grid or image with other contents, that can be read
  std::string lost;  ///< the first that is gone, or whose other contents cannot be told from damage; empty: none
};
ArtefactChanges changes_of(const nlohmann::ordered_json& recorded, const std::filesystem::path& folder);

}  // namespace brainshift::pipelines
