// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <string>

#include "segmentation/files/make_folder.hpp"

namespace brainshift::pipelines {
namespace {

/// Whether the open folder is still the one of that name: who held it before may have removed or renamed it.
bool is_still(const std::filesystem::path& folder, int file) {
  struct stat opened {
  }, named{};
  return fstat(file, &opened) == 0 && stat(folder.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder, std::string_view advice) : file_(-1) {
  while (file_ < 0) {
    make_folder(folder);
    file_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file_ < 0 && errno != ENOENT) {
      throw std::runtime_error(folder.string() + ": this folder cannot be opened");
    }
    // Some network file systems know no locks: there the folder is taken without one.
    if (file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      close(file_);
      throw std::runtime_error(folder.string() + ": another run is working in this folder; " + std::string(advice));
    }
    if (file_ >= 0 && !is_still(folder, file_)) {
      close(file_);
      file_ = -1;
    }
  }
}

FolderLock::~FolderLock() {
  close(file_);
}

}  // namespace brainshift::pipelines
