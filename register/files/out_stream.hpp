// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <system_error>

#include "segmentation/files/not_written.hpp"

namespace brainshift::registration {

/// A file that is written bit by bit; it is removed when it is not finished.
class OutStream {
 public:
  explicit OutStream(std::filesystem::path file) : file_(std::move(file)), stream_(file_, std::ios::binary) {}
  ~OutStream() {
    if (!finished_) {
      stream_.close();
      std::error_code ignored;
      std::filesystem::remove(file_, ignored);
    }
  }
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
    finished_ = true;
  }

 private:
  std::filesystem::path file_;
  std::ofstream stream_;
  bool finished_ = false;
};

}  // namespace brainshift::registration
