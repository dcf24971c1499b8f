// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "solve/cut/cut_timing.hpp"
#include "solve/interface/cut.hpp"

namespace brainshift::solve {

/// A path from a .csv, as read_cut_path(), else a sheet, as read_cut_sheet(). Throws std::invalid_argument, naming the
/// file, as they do and when there is no such file.
Cut read_cut(const std::filesystem::path& file, const CutTiming& timing = {});

}  // namespace brainshift::solve
