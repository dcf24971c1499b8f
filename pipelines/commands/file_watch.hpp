// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

namespace brainshift::pipelines {

/// What changes when a file is written, renamed, or given other permissions.
struct FileState {
  bool there = false;
  bool regular = false;  ///< no folder, pipe or device
  ino_t file = 0;
  off_t size = 0;
  std::array<std::int64_t, 4> times = {};  ///< of its contents, which a program may set, and of its status: s, ns

  bool operator==(const FileState&) const = default;
};

/// A warning where the file's last line has no end; empty where the file cannot be read: who reads it says why.
std::string want_of_newline(const std::filesystem::path& file);

/// Waits for a file that other programs write.
class FileWatch {
 public:
  /// The file may come later.
  explicit FileWatch(std::filesystem::path file);
  ~FileWatch();
  FileWatch(const FileWatch&) = delete;
  FileWatch& operator=(const FileWatch&) = delete;

  /// Blocks until the file is there, is not as it was when this last returned, and is whole: its writer has closed it
  /// or moved it into place, or it ends with a newline and has not changed for 2 s; for 20 ms where the system tells of
  /// no writer, as in a folder that another machine writes to. Returns its state. Throws std::invalid_argument, naming
  /// the file, where it has rested for 2 s without a newline at its end or is no regular file, and waits again when
  /// called again.
  FileState next();

 private:
  enum class Told : std::uint8_t { nothing, written, closed };

  bool is_whole() const;
  void wait();

  std::filesystem::path file_;
  int events_;                 ///< of the folder, from inotify; −1: none
  Told told_ = Told::nothing;  ///< by the event of the file that came last
  FileState seen_, returned_, refused_;
  std::chrono::steady_clock::time_point since_;  ///< is it as it was seen last
};

}  // namespace brainshift::pipelines
