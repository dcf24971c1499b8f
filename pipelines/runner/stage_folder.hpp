// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "pipelines/runner/folder_lock.hpp"
#include "pipelines/runner/interruption.hpp"

namespace brainshift::pipelines {

/// A folder that is written beside its place, under the name FOLDER.partial, and appears there when it is whole. One
/// that is not committed is removed. Throws std::runtime_error, naming the folder, when it cannot be made or moved or
/// another process is writing it, and std::invalid_argument when a FOLDER.partial is there that is not ours, and as
/// place_of().
class StageFolder {
 public:
  StageFolder(const std::filesystem::path& place, Interruption& interruption);
  ~StageFolder();
  StageFolder(const StageFolder&) = delete;
  StageFolder& operator=(const StageFolder&) = delete;

  const std::filesystem::path& path() const { return partial_; }

  /// Takes the place, and with it all that was there.
  void replace();
  /// Throws std::invalid_argument, naming the file, where merge() would take the place of one with other contents: it
  /// may be a patient's.
  void refuse_others_files() const;
  /// Moves the files into the place, each over one of the same name; other files there stay. The same with those in
  /// a folder, but std::invalid_argument is thrown, before any is moved, when other files are in the one there.
  void merge();

 private:
  std::filesystem::path place_;
  std::filesystem::path partial_;
  std::optional<FolderLock> lock_;
  Interruption& interruption_;
  bool replaced_ = false;
};

/// Throws std::invalid_argument: a file that lies there may be a patient's.
[[noreturn]] void refuse_to_replace(const std::filesystem::path& file);

/// The whole path of the folder that a user names, without a slash at its end. Throws std::invalid_argument when it is
/// empty, or a file.
std::filesystem::path place_of(const std::filesystem::path& named);

/// Where the folder that is replaced waits until the new one stands in its place: FOLDER.old.
std::filesystem::path old_of(const std::filesystem::path& place);

/// Writes a text file whole or not at all. Throws std::runtime_error, naming it.
void write_whole(const std::filesystem::path& file, const std::string& text);

}  // namespace brainshift::pipelines
