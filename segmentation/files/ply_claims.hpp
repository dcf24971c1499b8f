// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace brainshift {

/// Throws std::invalid_argument, naming the file, when a list in a PLY file says to be longer than what is left of the
/// file, or the file ends before its rows do: CGAL would allocate them. What is no PLY passes.
void check_ply_claims(const std::filesystem::path& file);

}  // namespace brainshift
