// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace brainshift {

/// Throws std::invalid_argument, naming the file, when a list in a PLY file says to be longer than what is left of the
/// file, or the file ends before its rows do: CGAL would allocate them. What is no PLY passes.
void check_ply_claims(const std::filesystem::path& file);

/// Of a number of a PLY file, by the name of its type; none for an unknown name.
std::optional<std::size_t> bytes_of_ply_type(const std::string& name);

}  // namespace brainshift
