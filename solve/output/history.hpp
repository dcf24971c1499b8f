// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "solve/interface/result.hpp"

namespace brainshift::solve {

/// history.csv: one row a look at the state. Throws std::runtime_error, naming the file, when it cannot be written
/// whole.
void write_history(const std::filesystem::path& file, const std::vector<HistoryRow>& history);

}  // namespace brainshift::solve
