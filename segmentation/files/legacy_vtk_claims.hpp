// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace brainshift {

/// Throws std::invalid_argument, naming the file, when the cells of a legacy .vtk of a version before 5 are not as many
/// numbers as it says, or a cell is longer than what is left of them: VTK would read beyond its arrays.
void check_legacy_vtk_claims(const std::filesystem::path& file);

}  // namespace brainshift
