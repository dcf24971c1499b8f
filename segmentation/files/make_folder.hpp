// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace brainshift {

/// Makes a folder and those above it. Throws std::runtime_error, naming it.
inline void make_folder(const std::filesystem::path& folder) {
  std::error_code fault;
  std::filesystem::create_directories(folder, fault);
  if (fault) {
    throw std::runtime_error(folder.string() + ": the folder cannot be made (" + fault.message() +
                             "); check the disk and your rights, or choose another folder");
  }
}

}  // namespace brainshift
