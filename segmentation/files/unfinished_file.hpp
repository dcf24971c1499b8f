// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

#include "segmentation/files/not_written.hpp"

namespace brainshift {

/// A new file of its own beside another, whose place it takes once it is whole. Until then the other stays as it was;
/// what is not finished goes. In place of a device, as /dev/stdout, it is the device itself.
class UnfinishedFile {
 public:
  /// Makes it, empty. ending: of its name, as libraries go by it. A link is followed to the file that it names. Throws
  /// std::runtime_error, naming the other, where that is a folder or write-protected, or its folder takes no file.
  UnfinishedFile(const std::filesystem::path& file, const std::string& ending)
      : file_(file), place_(file), path_(file) {
    std::error_code unknown;  // of a folder that may not be entered: opening a file there tells it
    if (std::filesystem::is_directory(file, unknown)) {
      throw std::runtime_error(file_.string() + ": is a folder; give the name of a file");
    }
    if (std::filesystem::is_other(file, unknown)) {
      return;
    }
    if (std::filesystem::exists(file, unknown)) {
      place_ = std::filesystem::canonical(file);
      if (::access(place_.c_str(), W_OK) != 0) {
        throw std::runtime_error(file_.string() + ": is write-protected; give another name");
      }
    }
    const std::string name = place_.string() + "." + std::to_string(::getpid()) + ".";
    int descriptor = -1;
    for (int i = 0; descriptor < 0 && (i == 0 || errno == EEXIST); ++i) {  // as of a process on another machine
      path_ = name + std::to_string(i) + ".part" + ending;
      descriptor = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    }
    if (descriptor < 0) {
      fail_to_write(file_);
    }
    if (struct stat other{}; ::stat(place_.c_str(), &other) == 0) {
      ::fchmod(descriptor, other.st_mode & 0777U);  // whoever may not read the other may not read this either
    }
    ::close(descriptor);
  }
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;
  ~UnfinishedFile() {
    if (path_ != place_) {
      std::error_code ignored;
      std::filesystem::remove(path_, ignored);
    }
  }

  const std::filesystem::path& path() const { return path_; }

  /// It takes the other's place. Throws std::runtime_error where it cannot.
  void finish() {
    std::error_code fault;
    if (path_ != place_) {
      std::filesystem::rename(path_, place_, fault);
    }
    if (fault) {
      fail_to_write(file_);
    }
  }

 private:
  std::filesystem::path file_, place_, path_;
};

}  // namespace brainshift
