// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace brainshift {

/// Throws std::invalid_argument, naming the file, when a VTK XML file says to hold more points, cells or components, or
/// components of them all, than its length allows for even when compressed, or an array of it more compressed blocks
/// than the file has bytes: VTK would allocate them.
void check_vtk_claims(const std::filesystem::path& file);

}  // namespace brainshift
