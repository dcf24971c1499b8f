// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "segmentation/files/not_written.hpp"

namespace brainshift {

/// Throws as fail_to_write() where the disk does not take all of it; then nothing is left of the file.
inline void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  std::error_code ignored;
  const bool ours = stream.is_open() && std::filesystem::is_regular_file(file, ignored);  // and no device
  stream << text;
  stream.close();
  if (!stream) {
    if (ours) {
      std::filesystem::remove(file, ignored);
    }
    fail_to_write(file);
  }
}

}  // namespace brainshift
