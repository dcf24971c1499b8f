// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "segmentation/image/frame_note.hpp"
#include "segmentation/image/image.hpp"

namespace brainshift::pipelines {

/// The label map of a file that need not be given.
inline std::optional<LabelMap> labels_if(const std::filesystem::path& file) {
  return file.empty() ? std::nullopt : std::optional(read_label_map(file));
}

/// Of images and fields whose files contradict themselves on their place or tell none: what was taken.
inline std::vector<std::string> frame_warnings(const std::set<std::filesystem::path>& files) {
  std::vector<std::string> warnings;
  for (const std::filesystem::path& file : files) {
    if (const std::string note = frame_note(file); !note.empty()) {
      warnings.push_back("warning: " + file.string() + ": " + note);
    }
  }
  return warnings;
}

}  // namespace brainshift::pipelines
