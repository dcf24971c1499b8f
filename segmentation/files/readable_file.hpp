// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <unistd.h>

#include <filesystem>
#include <system_error>

#include "segmentation/files/refuse.hpp"

namespace brainshift {

/// Throws std::invalid_argument, naming the file, when it is missing, empty, may not be read, or is no regular file: a
/// pipe or a device may never end.
inline void check_readable(const std::filesystem::path& file) {
  std::error_code fault;
  const auto status = std::filesystem::status(file, fault);
  if (status.type() == std::filesystem::file_type::not_found) {
    refuse(file, "no such file; check the path");
  }
  if (fault) {
    refuse(file, "cannot be reached (" + fault.message() + "); check the path and the permissions of its folders");
  }
  if (!std::filesystem::is_regular_file(status)) {
    refuse(file, "is a folder, a pipe or a device; a file is expected");
  }
  if (::access(file.c_str(), R_OK) != 0) {
    refuse(file, "you have no permission to read it; change the file's permissions");
  }
  if (std::filesystem::file_size(file, fault) == 0) {
    refuse(file, "the file is empty; copy it again");
  }
}

}  // namespace brainshift
