// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>

#include "segmentation/surface/surface.hpp"

namespace brainshift::registration {

/// Takes points, (n × 3) mm LPS, to where they are to be written.
using MovePoints = std::function<Points(const Points&)>;

/// Copies a table of points with its positions moved; all other columns, comments and the frame stay. The columns are
/// named by the first line that is no comment (.csv) or by a comment "# columns = id,x,y,z,…" (.fcsv; without it
/// these); the frame by a comment "# frame: LPS" or "# CoordinateSystem = LPS" (LPS, RAS, 0 for RAS, 1 for LPS). Throws
/// std::invalid_argument with file and line where a line does not parse, is not finite, or the frame is not named.
void copy_point_table(const std::filesystem::path& in, const std::filesystem::path& out, const MovePoints& move);

/// The same for 3D Slicer's .mrk.json: points whose positionStatus is not "defined" stay. Throws std::invalid_argument
/// with file and point.
void copy_markups(const std::filesystem::path& in, const std::filesystem::path& out, const MovePoints& move);

}  // namespace brainshift::registration
