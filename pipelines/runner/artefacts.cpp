// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/artefacts.hpp"

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include "discretise/interface/background_cells.hpp"
#include "discretise/interface/node_cloud.hpp"
#include "pipelines/checksum/sha256.hpp"
#include "pipelines/runner/own_folder.hpp"
#include "segmentation/files/surface_file.hpp"
#include "segmentation/image/image.hpp"
#include "solve/output/solution_file.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

template <class Read>
bool can(const Read& read) {
  try {
    read();
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

/// Whether it is whole, as far as its format tells.
bool is_readable(const fs::path& file) {
  const std::string name = file.filename().string();
  if (name.ends_with(".vtp")) {
    return can([&] { read_surface(file); });
  }
  if (name == "nodes.vtu") {
    return can([&] { read_node_cloud(file); });
  }
  if (name == "cells.vtu") {
    return can([&] { read_background_cells(file); });
  }
  if (name == "solution.vtu") {
    return can([&] { read_solution(file); });
  }
  return name.ends_with(".nii.gz") && (can([&] { read_image(file); }) || can([&] { read_vector_image(file); }));
}

bool is_as_recorded(const nlohmann::ordered_json& entry, const fs::path& file) {
  std::error_code fault;
  return entry.is_object() && entry.contains("bytes") && entry["bytes"] == fs::file_size(file, fault) &&
         entry.contains("sha256") && entry["sha256"] == sha256_of_file(file);
}

}  // namespace

nlohmann::ordered_json artefacts_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path name = entry.path().lexically_relative(folder);
    if (entry.is_regular_file() && name != "stage.json" && name != unfinished_mark) {
      files.push_back(name);
    }
  }
  std::ranges::sort(files);
  nlohmann::ordered_json artefacts = nlohmann::ordered_json::object();
  for (const fs::path& name : files) {
    artefacts[name.string()] = {{"bytes", fs::file_size(folder / name)}, {"sha256", sha256_of_file(folder / name)}};
  }
  return artefacts;
}

ArtefactChanges changes_of(const nlohmann::ordered_json& recorded, const fs::path& folder) {
  ArtefactChanges changes;
  for (const auto& [name, entry] : recorded.items()) {
    const fs::path file = folder / name;
    std::error_code fault;
    if (!fs::is_regular_file(file, fault)) {
      changes.lost = name;
    } else if (is_as_recorded(entry, file)) {
      continue;
    } else if (is_readable(file)) {
      changes.edited.push_back(name);
    } else {
      changes.lost = name;
    }
    if (!changes.lost.empty()) {
      break;
    }
  }
  return changes;
}

}  // namespace brainshift::pipelines
