// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>

namespace brainshift::pipelines {

/// What changes when a file is written.
struct FileState {
  bool there = false;
  ino_t file = 0;
  off_t size = 0;
  time_t second = 0;
  long nanosecond = 0;

  bool operator==(const FileState&) const = default;
};

/// Waits for a file that other programs write.
class FileWatch {
 public:
  /// The file may come later.
  explicit FileWatch(std::filesystem::path file);
  ~FileWatch();
  FileWatch(const FileWatch&) = delete;
  FileWatch& operator=(const FileWatch&) = delete;

  /// Blocks until the file is there, is not as it was when this last returned, and is whole: its writer has closed it
  /// or moved it into place, or it has not changed for 20 ms, as where the system tells nothing about its folder (one
  /// that another machine writes to). Returns its state.
  FileState next();

 private:
  void wait();

  std::filesystem::path file_;
  int events_;           ///< of the folder, from inotify; −1: none
  bool closed_ = false;  ///< by the event of the file that came last
  FileState seen_, returned_;
  std::chrono::steady_clock::time_point since_;
};

}  // namespace brainshift::pipelines
