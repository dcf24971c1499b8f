// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "segmentation/files/write_text.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift {

using test::bytes_of;
using test::ScratchFolder;

struct ProgramResult {
  int code = 0;
  std::string out;
  std::string err;
};

/// Runs `command` with /bin/sh, where "brainshift" stands for the program that was built.
ProgramResult run_shell(const std::string& command);

/// The rows of a .csv, lines of comments left out: values by the names of their columns.
std::vector<std::map<std::string, double>> read_table(const std::filesystem::path& file);

/// Names ending in .partial or .old, or with .part. in them, anywhere under the folder, and of its own beside it: what
/// a stopped program must not leave.
std::vector<std::string> half_written(const std::filesystem::path& folder);

}  // namespace brainshift
