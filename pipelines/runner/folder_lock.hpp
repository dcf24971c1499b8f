// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

namespace brainshift::pipelines {

/// Holds a folder, which it makes, against other processes: two runs in one folder would tear each other's files apart.
/// Throws std::runtime_error, naming the folder, when another one holds it, with advice, or when it cannot be made or
/// opened.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder,
                      std::string_view advice = "wait for it or choose another --out");
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
};

}  // namespace brainshift::pipelines
