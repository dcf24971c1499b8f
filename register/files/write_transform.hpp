// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>

#include "segmentation/image/image.hpp"

namespace brainshift::registration {

enum class Packing : std::uint8_t {
  deflated,  ///< a third of the size
  plain,     ///< written at once
};

/// A field as an ITK displacement field transform (.h5: 3D Slicer, SimpleITK and ANTs load it), in single precision.
/// Such a transform is the identity outside its grid. itk::TransformFileWriter makes the same file, but compresses it
/// on one thread. Throws std::runtime_error when it cannot be written whole.
void write_transform(const std::filesystem::path& file, const VectorImage& field, Packing packing = Packing::deflated);

}  // namespace brainshift::registration
