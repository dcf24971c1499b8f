// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "solve/cut/cut_timing.hpp"
#include "solve/interface/cut.hpp"

namespace brainshift::solve {

/// A cut in space from a surface that read_surface() reads; a .vtp may hold the point array `time`. Its triangles are
/// turned to agree with the first; points that no triangle names are left out. Throws std::invalid_argument, naming the
/// file, when it cannot be read, is no sheet (oriented_sheet()), crosses or touches itself, has times that are negative
/// or not finite, times and a timing too, or a speed without a direction.
Cut read_cut_sheet(const std::filesystem::path& file, const CutTiming& timing);

}  // namespace brainshift::solve
