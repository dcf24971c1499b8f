// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <vector>

namespace brainshift {

/// Points and polygons (vertex indices from 0) as a file holds them.
struct PolygonSoup {
  std::vector<std::array<double, 3>> points;
  std::vector<std::vector<std::size_t>> polygons;
};

/// The vertices and faces of a Wavefront .obj; texture, normals and groups are passed over. Throws
/// std::invalid_argument with the file and line that does not parse. By hand because VTK's reader rounds coordinates to
/// float and doubles vertices along seams of a texture, and CGAL's names no line.
PolygonSoup read_obj(const std::filesystem::path& file);

}  // namespace brainshift
