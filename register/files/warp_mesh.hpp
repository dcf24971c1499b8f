// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "register/warp/point_mover.hpp"

namespace brainshift::registration {

/// Moves the vertices of a .obj in its own frame. Every other line stays as it is: colours behind the coordinates,
/// normals, textures, groups, lines. Throws as warp_any().
void warp_obj(const std::filesystem::path& in, PointMover& mover, const std::filesystem::path& out);

/// The same of a .ply, in text or either binary form: header, other properties and other elements stay byte for byte.
/// What goes along with the vertices become properties behind theirs. Points without faces are fine in both.
void warp_ply(const std::filesystem::path& in, PointMover& mover, const std::filesystem::path& out);

}  // namespace brainshift::registration
