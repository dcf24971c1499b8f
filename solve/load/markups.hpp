// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "segmentation/surface/surface.hpp"

namespace brainshift::solve {

/// The control points of one 3D Slicer markup.
struct Markup {
  Points positions;  ///< mm, LPS
  std::vector<std::string> labels;
};

/// Reads .mrk.json or .fcsv, by the file's ending. Throws std::invalid_argument, naming file and line or point.
Markup read_markup(const std::filesystem::path& file);

}  // namespace brainshift::solve
