// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/input_states.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <system_error>
#include <vector>

#include "pipelines/checksum/sha256.hpp"
#include "segmentation/files/refuse.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

/// The time of the last change of status cannot be set back, as that of the contents can.
std::string written(const fs::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) {
    return "gone";
  }
  std::string text = std::to_string(status.st_size);
  for (const timespec& time : {status.st_mtim, status.st_ctim}) {
    text += " " + std::to_string(time.tv_sec) + "." + std::to_string(time.tv_nsec);
  }
  return text;
}

/// Of a folder: of the files in it.
std::string all_written(const fs::path& file) {
  std::error_code fault;
  if (!fs::is_directory(file, fault)) {
    return written(file);
  }
  std::vector<std::string> lines;
  for (fs::directory_iterator entry(file, fault), end; !fault && entry != end; entry.increment(fault)) {
    lines.push_back(entry->path().filename().string() + " " + written(entry->path()) + "\n");
  }
  std::ranges::sort(lines);
  std::string text;
  for (const std::string& line : lines) {
    text += line;
  }
  return text;
}

}  // namespace

InputStates::State InputStates::state_of(const fs::path& file) {
  std::string before = all_written(file);  // first: what is written while it is read must show
  return {.written = std::move(before), .sha256 = sha256_of_file(file)};
}

const InputStates::State& InputStates::first(const fs::path& file) {
  const auto found = states_.find(file);
  return found != states_.end() ? found->second : states_.emplace(file, state_of(file)).first->second;
}

const std::string& InputStates::sha256(const fs::path& file) {
  return first(file).sha256;
}

void InputStates::check_unchanged(const fs::path& file) {
  const State& then = first(file);
  // A clock that ticks in milliseconds misses a change that follows at once: hence the contents too.
  if (all_written(file) != then.written || sha256_of_file(file) != then.sha256) {
    refuse(file, "changed while it was read; run again once nothing writes to it");
  }
}

}  // namespace brainshift::pipelines
