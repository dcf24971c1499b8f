// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace brainshift {

struct PlyProperty {
  std::string name, type;                       ///< type of the number, of a list that of its items
  std::size_t bytes = 0;                        ///< of such a number
  std::optional<std::size_t> count_bytes = {};  ///< of a list: of its count
};

struct PlyElement {
  std::string name;
  std::uint64_t rows = 0;
  std::vector<PlyProperty> properties = {};
};

struct PlyHeader {
  std::string format;
  std::vector<PlyElement> elements = {};  ///< in the order of the file
};

/// The header of a PLY file. Throws std::invalid_argument, naming the file, when it is none, when a list says to be
/// longer than what is left of the file, or when the file ends before its rows do: CGAL would allocate them.
PlyHeader check_ply_claims(const std::filesystem::path& file);

}  // namespace brainshift
