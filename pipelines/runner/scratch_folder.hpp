// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>

#include "pipelines/runner/folder_lock.hpp"
#include "pipelines/runner/interruption.hpp"

namespace brainshift::pipelines {

/// A folder among the system's temporary files that goes with this object, or with the program when it is interrupted.
/// What programs left that were killed goes, too. Throws std::runtime_error when none can be made.
class ScratchFolder {
 public:
  explicit ScratchFolder(Interruption& interruption);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::optional<FolderLock> lock_;
  Interruption& interruption_;
};

}  // namespace brainshift::pipelines
