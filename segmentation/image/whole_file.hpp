// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Private: faults of a file that ITK's readers pass over.

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "segmentation/image/image_format.hpp"
#include "segmentation/image/image_header.hpp"

namespace brainshift {

/// Whether values that are NaN are what nobody knows, or a fault as infinite ones are.
enum class Gaps : std::uint8_t { refused, allowed };

inline bool is_fault(double value, Gaps gaps) {
  return !std::isfinite(value) && !(gaps == Gaps::allowed && std::isnan(value));
}

/// Reads the header, checks it (image_header.hpp), and that the voxels it promises are there: whole after decompression
/// and, in NIfTI, finite. ITK's readers take zeros, or memory that nobody set, for what is not. Throws
/// std::invalid_argument, naming the file.
ImageHeader check_whole(const std::filesystem::path& file, ImageFormat format, std::uint64_t components,
                        Gaps gaps = Gaps::refused);

/// The same of a .nii or .nii.gz with a fourth axis, one value a voxel.
ImageHeader check_whole_series(const std::filesystem::path& file);

/// Which numbers of a whole .nii or .nii.gz are NaN, in its order: ITK reads them as 0.
std::vector<std::size_t> nifti_nans(const std::filesystem::path& file);

/// "voxel (i, j, k)" of an offset into the voxels.
std::string voxel_name(const Eigen::Array3i& size, std::size_t offset);

/// Throws the sentence about values that are not finite.
[[noreturn]] void refuse_not_finite(const std::filesystem::path& file, std::ptrdiff_t count, const Eigen::Array3i& size,
                                    std::size_t first_voxel, Gaps gaps);

}  // namespace brainshift
