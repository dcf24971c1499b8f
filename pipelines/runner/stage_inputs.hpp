// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pipelines/scene/scene.hpp"

namespace brainshift::pipelines {

struct InputFile {
  std::string role;  ///< "t1", "labels", "segment/brain.vtp", ...
  std::filesystem::path path;
};

/// The user's own files that a scene names, with their roles.
std::vector<InputFile> scene_files(const Scene& scene);

/// Those of them that these elements of the scene name, or elements within them.
std::vector<InputFile> files_of(const Scene& scene, const std::vector<std::string>& elements);

/// Options of these elements, as text, without those that name files: files count by their contents.
nlohmann::ordered_json options_of(const Scene& scene, const std::vector<std::string>& elements);

/// <load> and what lies within it, where the scene has them.
std::vector<std::string> elements_of_load(const Scene& scene);

/// The file where it is there; else empty.
std::filesystem::path if_there(const std::filesystem::path& file);

/// Artefacts of earlier stages, those of them that are there.
void add_artefacts(std::vector<InputFile>& inputs, const std::filesystem::path& folder,
                   const std::vector<std::string>& names);

}  // namespace brainshift::pipelines
