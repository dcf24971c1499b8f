// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "register/warp/point_mover.hpp"

namespace brainshift::registration {

/// Moves the points of a .vtp, .vtu or .vtk in its own frame. All arrays and cells stay as they are (so do normals);
/// the point array "displacement" (mm, in that frame) joins them, and what goes along with the points;
/// "warp_" goes before the name of an array that is there already. Throws as warp_any().
void warp_model(const std::filesystem::path& in, PointMover& mover, const std::filesystem::path& out);

}  // namespace brainshift::registration
