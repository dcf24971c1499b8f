// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>

#include "segmentation/image/image.hpp"

namespace brainshift::pipelines {

/// The label map of a file that need not be given.
inline std::optional<LabelMap> labels_if(const std::filesystem::path& file) {
  return file.empty() ? std::nullopt : std::optional(read_label_map(file));
}

}  // namespace brainshift::pipelines
