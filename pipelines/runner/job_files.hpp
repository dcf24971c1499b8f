// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "segmentation/image/image.hpp"

namespace brainshift::pipelines {

/// The label map of a file that need not be given.
inline std::optional<LabelMap> labels_if(const std::filesystem::path& file) {
  return file.empty() ? std::nullopt : std::optional(read_label_map(file));
}

/// Runs a stage. A stage knows no files: what it refuses is what these hold.
template <class Work>
auto naming(const std::string& files, const Work& work) {
  try {
    return work();
  } catch (const std::invalid_argument& fault) {
    throw std::invalid_argument(files.empty() ? fault.what() : files + ": " + fault.what());
  }
}

}  // namespace brainshift::pipelines
