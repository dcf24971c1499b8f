// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace brainshift::pipelines {

/// The files and folders that a run reads, each as it was when it was first asked for: a result must not be kept under
/// the checksum of a file that was another one while it was read.
class InputStates {
 public:
  /// SHA-256 of the contents then. Throws std::invalid_argument, naming the file, when it cannot be read.
  const std::string& sha256(const std::filesystem::path& file);

  /// Throws std::invalid_argument, naming the file, when it has changed or was written since it was first asked for,
  /// even if it holds the same again.
  void check_unchanged(const std::filesystem::path& file);

 private:
  struct State {
    std::string written;  ///< sizes and times
    std::string sha256;
  };
  static State state_of(const std::filesystem::path& file);
  const State& first(const std::filesystem::path& file);

  std::map<std::filesystem::path, State> states_;
};

}  // namespace brainshift::pipelines
