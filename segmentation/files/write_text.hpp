// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "segmentation/files/unfinished_file.hpp"

namespace brainshift {

/// What was there before stays as it was where the disk does not take all of it. Throws as fail_to_write() and
/// UnfinishedFile do. A device, as /dev/stdout, is written to itself.
inline void write_text(const std::filesystem::path& file, const std::string& text) {
  const auto write_to = [&](const std::filesystem::path& place) {
    std::ofstream stream(place, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) {
      fail_to_write(file);
    }
  };
  std::error_code unknown;
  if (std::filesystem::is_other(file, unknown)) {
    return write_to(file);
  }
  UnfinishedFile unfinished(file, "");
  write_to(unfinished.path());
  unfinished.finish();
}

}  // namespace brainshift
