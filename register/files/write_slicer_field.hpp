// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "segmentation/image/image.hpp"

namespace brainshift::registration {

/// A resampling field as a .nrrd that 3D Slicer takes for a displacement field transform of the type `resampling`, mm,
/// LPS. ITK's writer makes the same file, but compresses it on one thread. Throws std::runtime_error, naming the file,
/// when it cannot be written whole.
void write_slicer_field(const std::filesystem::path& file, const VectorImage& resampling);

}  // namespace brainshift::registration
