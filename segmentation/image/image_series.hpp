// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "segmentation/image/image.hpp"

namespace brainshift {

/// Volumes of one grid behind each other, in time or by direction of a gradient: a 4-D NIfTI.
struct ImageSeries {
  std::vector<ScalarImage> volumes;
  double start = 0, step = 1;  ///< of the fourth axis; s where it is time
};

/// Whether a .nii or .nii.gz holds more than one volume. Throws std::invalid_argument, naming the file, when its header
/// cannot be; any other file holds one.
bool is_image_series(const std::filesystem::path& file);

/// Throws std::invalid_argument as read_image() does, and when there are more values than are read.
ImageSeries read_image_series(const std::filesystem::path& file);

/// Throws as write_image().
void write_image_series(const std::filesystem::path& file, const ImageSeries& series);

}  // namespace brainshift
