// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace brainshift {

/// The absolute name of a file that a user names, without `.` and `..`. As for the system, `..` behind a symbolic link
/// leaves the folder that the link leads to; a name without `..` keeps its links.
inline std::filesystem::path whole_path(const std::filesystem::path& named) {
  const std::filesystem::path whole = std::filesystem::absolute(named);
  if (std::find(whole.begin(), whole.end(), "..") == whole.end()) {
    return whole.lexically_normal();
  }
  const bool ends_so = whole.filename().empty() || whole.filename() == ".." || whole.filename() == ".";
  std::error_code fault;
  const std::filesystem::path folder = std::filesystem::weakly_canonical(ends_so ? whole : whole.parent_path(), fault);
  return fault ? whole.lexically_normal() : ends_so ? folder : folder / whole.filename();
}

}  // namespace brainshift
