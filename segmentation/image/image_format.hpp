// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Private: which of ITK's readers and writers takes a file. Chosen explicitly, so no factory has to be registered.

#include <Eigen/Dense>  // before ITK, which brings an Eigen of its own under the same include guards

#include <itkImageIOBase.h>

#include <filesystem>

namespace brainshift {

enum class ImageFormat : std::uint8_t { nifti, nifti_gz, nrrd, meta, mgh };

/// By the ending, in any case. Throws std::invalid_argument, naming the file and the endings that are known.
ImageFormat image_format(const std::filesystem::path& file);

/// Throws std::invalid_argument for MGH, which ITK does not know.
itk::ImageIOBase::Pointer make_image_io(ImageFormat format);

}  // namespace brainshift
