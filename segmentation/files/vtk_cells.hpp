// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Bridge to VTK, for .cpp files: what a reader must look at before a model is used. Not a public header.

#include <vtkPointSet.h>

#include <filesystem>

namespace brainshift {

/// VTK trusts what a file says of its cells. Throws std::invalid_argument, naming the file, where the offsets of one do
/// not ascend within the corners, or one names a point that does not exist.
void check_cells(const std::filesystem::path& file, vtkPointSet& model);

}  // namespace brainshift
