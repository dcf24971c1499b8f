// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <stdexcept>

namespace brainshift {

/// Throws std::runtime_error of a file, or a folder of files, that the disk did not take.
[[noreturn]] inline void fail_to_write(const std::filesystem::path& file) {
  throw std::runtime_error(file.string() + ": could not be written whole; is the disk full or the folder read-only?");
}

}  // namespace brainshift
