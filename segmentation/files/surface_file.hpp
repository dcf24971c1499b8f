// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <string_view>

#include "segmentation/geometry/surface.hpp"

namespace brainshift {

/// How files of surfaces end, and the same as a sentence lists it.
inline constexpr std::array<std::string_view, 4> surface_endings = {".vtp", ".stl", ".ply", ".obj"};
inline constexpr const char* listed_surface_endings = ".vtp, .stl, .ply, .obj";

/// Reads .vtp, .stl, .ply or .obj. Faces with more than three corners are triangulated, repeated points (STL) merged.
/// Coordinates are taken as LPS, unless the file carries 3D Slicer's note SPACE=RAS: then x and y change sign.
/// Throws std::invalid_argument, naming the file, when it cannot be read, holds no triangle or a non-finite coordinate.
Surface read_surface(const std::filesystem::path& file);

/// Writes by the file's ending (.vtp, .stl, .ply, .obj), with 3D Slicer's note SPACE=LPS; all but .stl keep doubles.
/// Throws std::runtime_error when the file cannot be written whole.
void write_surface(const std::filesystem::path& file, const Surface& surface);

}  // namespace brainshift
