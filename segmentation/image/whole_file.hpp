// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Private: faults of a file that ITK's readers pass over.

#include <Eigen/Dense>
#include <cstddef>
#include <filesystem>
#include <string>

#include "segmentation/image/image_format.hpp"

namespace brainshift {

/// Throws std::invalid_argument when the file holds fewer voxels than its header says, or, in NIfTI, values that are
/// not finite: ITK's reader takes zeros for both. io must have read the header.
void check_whole(const std::filesystem::path& file, ImageFormat format, const itk::ImageIOBase& io);

/// "voxel (i, j, k)" of an offset into the voxels.
std::string voxel_name(const Eigen::Array3i& size, std::size_t offset);

/// Throws the sentence about values that are not finite.
[[noreturn]] void refuse_not_finite(const std::filesystem::path& file, std::ptrdiff_t count, const Eigen::Array3i& size,
                                    std::size_t first_voxel);

}  // namespace brainshift
