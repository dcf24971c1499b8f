// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>

#include "segmentation/files/unfinished_file.hpp"

namespace brainshift::registration {

/// A file that is written bit by bit. Until it is finished, what was there before stays as it was.
class OutStream {
 public:
  /// Throws as UnfinishedFile does.
  explicit OutStream(const std::filesystem::path& file)
      : file_(file), unfinished_(file, ""), stream_(unfinished_.path(), std::ios::binary) {}
  OutStream(const OutStream&) = delete;
  OutStream& operator=(const OutStream&) = delete;

  void write(const void* bytes, std::size_t count) {
    stream_.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(count));
  }

  /// All that is left to be read there.
  void write(std::istream& from) { stream_ << from.rdbuf(); }

  /// Throws std::runtime_error when not all could be written.
  void finish() {
    stream_.close();
    if (!stream_) {
      fail_to_write(file_);
    }
    unfinished_.finish();
  }

 private:
  std::filesystem::path file_;
  UnfinishedFile unfinished_;
  std::ofstream stream_;
};

}  // namespace brainshift::registration
