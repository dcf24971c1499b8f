// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "solve/cut/cut_timing.hpp"
#include "solve/interface/cut.hpp"

namespace brainshift::solve {

/// A cut of a plane problem from a CSV: lines that start with # aside, the header `x,y` or `x,y,time` (mm; time of the
/// load's curve), then one vertex a line, in the order in which they are cut. Throws std::invalid_argument, naming file
/// and line, when it cannot be read, has fewer than two vertices, repeats one, meets itself, has times that fall or are
/// negative, or times and a timing too.
Cut read_cut_path(const std::filesystem::path& file, const CutTiming& timing);

/// The same through vertices x, y (mm) that stand elsewhere; `name` is what messages call the path.
Cut cut_path(const std::vector<std::pair<double, double>>& vertices, const CutTiming& timing, const std::string& name);

}  // namespace brainshift::solve
