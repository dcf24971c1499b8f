// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/own_folder.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

constexpr std::array marks = {unfinished_mark, "stage.json"};

bool is_mark(const fs::path& file) {
  return std::ranges::find(marks, file.filename().string()) != marks.end();
}

}  // namespace

bool is_own_folder(const fs::path& folder) {
  std::error_code fault;
  if (fs::symlink_status(folder, fault).type() != fs::file_type::directory) {
    return false;
  }
  const bool marked = std::ranges::any_of(marks, [&](const char* mark) { return fs::exists(folder / mark, fault); });
  return marked || fs::is_empty(folder, fault);
}

void refuse_foreign_folder(const fs::path& folder) {
  std::error_code fault;
  const bool there = fs::symlink_status(folder, fault).type() != fs::file_type::not_found;
  if (there && !is_own_folder(folder)) {
    throw std::invalid_argument(folder.string() +
                                ": this was not made by brainshift and would be overwritten; move it "
                                "away or choose another --out");
  }
}

void clear_own_folder(const fs::path& folder) {
  std::error_code fault;
  std::vector<fs::path> entries;
  for (fs::directory_iterator entry(folder, fault), end; !fault && entry != end; entry.increment(fault)) {
    entries.push_back(entry->path());
  }
  std::stable_partition(entries.begin(), entries.end(), [](const fs::path& entry) { return !is_mark(entry); });
  for (const fs::path& entry : entries) {
    fs::remove_all(entry, fault);
  }
}

void remove_own_folder(const fs::path& folder) {
  clear_own_folder(folder);
  std::error_code fault;
  fs::remove_all(folder, fault);
}

}  // namespace brainshift::pipelines
