// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "pipelines/runner/interruption.hpp"

namespace brainshift::pipelines {

/// A folder that is written beside its place, under the name FOLDER.partial, and appears there when it is whole. One
/// that is not committed is removed. Throws std::runtime_error, naming the folder, when it cannot be made or moved.
class StageFolder {
 public:
  StageFolder(const std::filesystem::path& place, Interruption& interruption);
  ~StageFolder();
  StageFolder(const StageFolder&) = delete;
  StageFolder& operator=(const StageFolder&) = delete;

  const std::filesystem::path& path() const { return partial_; }

  /// Takes the place, and with it all that was there.
  void replace();
  /// Moves the files into the place, each over one of the same name; other files there stay.
  void merge();

 private:
  std::filesystem::path place_;
  std::filesystem::path partial_;
  Interruption& interruption_;
};

/// Writes a text file whole or not at all. Throws std::runtime_error, naming it.
void write_whole(const std::filesystem::path& file, const std::string& text);

}  // namespace brainshift::pipelines
