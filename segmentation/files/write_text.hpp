// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "segmentation/files/unfinished_file.hpp"

namespace brainshift {

/// What was there before stays as it was where the disk does not take all of it. Throws as fail_to_write() and
/// UnfinishedFile do.
inline void write_text(const std::filesystem::path& file, const std::string& text) {
  UnfinishedFile unfinished(file, "");
  std::ofstream stream(unfinished.path(), std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) {
    fail_to_write(file);
  }
  unfinished.finish();
}

}  // namespace brainshift
